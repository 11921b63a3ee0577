/* ui_overlay.h: bindings, vertex locations and push constants of ui_overlay.{vert,frag}. */
#ifndef SHADERS_OUTPUT_UI_OVERLAY_H
#define SHADERS_OUTPUT_UI_OVERLAY_H
#include "abi.h"

#define OVERLAY_FONT 0

/* Vertex attribute locations. */
#define OVERLAY_POSITION 0
#define OVERLAY_UV       1
#define OVERLAY_COLOR    2

struct overlay_push {
    vec2s clip_from_pixel; /* clip = clip_from_pixel * pixel - 1 */
};

#endif
