/* gbuffer.h: bindings and push constants of the G-buffer passes, and the clear value of
 * gbuffer_normal. */
#ifndef SHADERS_OUTPUT_GBUFFER_H
#define SHADERS_OUTPUT_GBUFFER_H
#include "abi.h"

#define GBUFFER_NORMAL       1  /* gbuffer_normal, in passes that read it */
#define GBUFFER_STARTS       14 /* texture: first vertex of each opaque object */
#define GBUFFER_STARTS_WIDTH 2048

/* Depth and distance of background pixels: finite, but greater than those of any surface. */
#define GBUFFER_NOTHING 1e10f

struct gbuffer_push {
    uint32_t id;     /* object number (surroundings: base number) */
    uint32_t object; /* 1: refractive object; 0: surroundings */
    uint32_t count;  /* number of objects in GBUFFER_STARTS */
};

#endif
