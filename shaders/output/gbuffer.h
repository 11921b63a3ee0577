/* gbuffer.h: push constants of the G-buffer passes, and the clear value of gbuffer_position. */
#ifndef SHADERS_OUTPUT_GBUFFER_H
#define SHADERS_OUTPUT_GBUFFER_H
#include "abi.h"

/* Value of gbuffer_position.w in pixels without a surface: finite, but beyond all surfaces. */
#define GBUFFER_NOTHING 1e10f

struct gbuffer_push {
    uint32_t object; /* 1: refractive object; 0: surroundings */
};

#endif
