/* gbuffer.h: shared by gbuffer.c, gbuffer.vert and readers of gbuffer_position. */
#ifndef SHADERS_GBUFFER_H
#define SHADERS_GBUFFER_H
#include "abi.h"

/* The value of gbuffer_position.w without a surface: finite, but beyond all surfaces. */
#define GBUFFER_NOTHING 1e10f

struct gbuffer_push {
    uint32_t object; /* 1: the object; 0: its surroundings */
};

#endif
