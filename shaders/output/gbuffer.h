/* gbuffer.h: push constants of the G-buffer passes, and the clear value of gbuffer_position. */
#ifndef SHADERS_OUTPUT_GBUFFER_H
#define SHADERS_OUTPUT_GBUFFER_H
#include "abi.h"

#define GBUFFER_NORMAL 1 /* binding of the normals in gbuffer_camera_normal.frag */

/* Distance in gbuffer_normal.w and gbuffer_position.w of background pixels: finite, but greater
 * than that of any surface. */
#define GBUFFER_NOTHING 1e10f

struct gbuffer_push {
    uint32_t object; /* 1: refractive object; 0: surroundings */
};

#endif
