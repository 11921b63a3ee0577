/* overlay.h: what overlay.c and overlay.{vert,frag} agree on. */
#ifndef SHADERS_OVERLAY_H
#define SHADERS_OVERLAY_H
#include "abi.h"

#define OVERLAY_FONT 0

/* fields of a vertex */
#define OVERLAY_POSITION 0
#define OVERLAY_UV       1
#define OVERLAY_COLOR    2

struct overlay_push {
    vec2s clip_from_pixel; /* scale; the top left pixel's corner is (-1, -1) */
    uint32_t encodes;      /* as of present_push */
};

#endif
