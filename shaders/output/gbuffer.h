/* gbuffer.h: bindings and push constants of the G-buffer passes, and the clear value of
 * gbuffer_position. */
#ifndef SHADERS_OUTPUT_GBUFFER_H
#define SHADERS_OUTPUT_GBUFFER_H
#include "abi.h"

#define GBUFFER_NORMAL       1  /* normals, in gbuffer_camera_normal.frag */
#define GBUFFER_STARTS       14 /* texture: first vertex of each opaque object */
#define GBUFFER_STARTS_WIDTH 2048

/* Distance in gbuffer_normal.w and gbuffer_position.w of background pixels: finite, but greater
 * than that of any surface. */
#define GBUFFER_NOTHING 1e10f

struct gbuffer_push {
    uint32_t id;     /* object number (surroundings: base number) */
    uint32_t object; /* 1: refractive object; 0: surroundings */
    uint32_t count;  /* number of objects in GBUFFER_STARTS */
};

#endif
