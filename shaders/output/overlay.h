/* overlay.h: bindings, vertex locations and push constants of overlay.{vert,frag}. */
#ifndef SHADERS_OUTPUT_OVERLAY_H
#define SHADERS_OUTPUT_OVERLAY_H
#include "abi.h"

#define OVERLAY_FONT 0

/* Vertex attribute locations. */
#define OVERLAY_POSITION 0
#define OVERLAY_UV       1
#define OVERLAY_COLOR    2

struct overlay_push {
    vec2s clip_from_pixel; /* pixels to clip space: scale, then -1 */
};

#endif
