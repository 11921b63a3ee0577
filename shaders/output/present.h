/* present.h: bindings and push constants for presenting the image in the window. */
#ifndef SHADERS_OUTPUT_PRESENT_H
#define SHADERS_OUTPUT_PRESENT_H
#include "abi.h"

#define PRESENT_IMAGE 0

/* Specialisation constant: 1 if the shader must decode the image, because the swapchain encodes
 * sRGB. With a push constant instead, lavapipe would decode all pixels even at 0. */
#define PRESENT_ENCODES 0

/* Tests for the bright and dark columns between two images, which are visible on any content. */
#define PRESENT_IS_BRIGHT(column, line) ((column) == (line))
#define PRESENT_IS_DARK(column, line)   ((column) == (line) + 1u)
#define PRESENT_NO_LINE                 0xfffffff0u

/* Placement of the image in the window. The vertex shader computes texture coordinates, because
 * this saves a third of the scaling pass's time on lavapipe. */
struct present_push {
    vec2s uv_from_clip; /* uv per unit of clip space */
    vec2s uv_of_center; /* texture coordinates at the centre of the window */
    uint32_t x, y;      /* position of the image's first pixel in the window */
};

#endif
