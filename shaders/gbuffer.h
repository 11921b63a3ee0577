/* gbuffer.h: what gbuffer.c, gbuffer.vert and readers of gbuffer_position agree on. */
#ifndef SHADERS_GBUFFER_H
#define SHADERS_GBUFFER_H
#include "abi.h"

/* gbuffer_position.w where no surface is seen: farther than any surface, yet a number. */
#define GBUFFER_NOTHING 1e10f

struct gbuffer_push {
    uint32_t object; /* 1: the object; 0: its surroundings */
};

#endif
