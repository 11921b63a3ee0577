/* present.h: bindings and push constants for presenting the image in the window. */
#ifndef SHADERS_OUTPUT_PRESENT_H
#define SHADERS_OUTPUT_PRESENT_H
#include "abi.h"

#define PRESENT_IMAGE 0

/* Specialisation constant that is 1 if the swapchain's format converts shader output to sRGB. If it
 * were a push constant, lavapipe would execute the decoding for every pixel even if it is off. */
#define PRESENT_ENCODES 0

/* Two images side by side are separated by a bright and a dark column, visible on any content. */
#define PRESENT_IS_BRIGHT(column, line) ((column) == (line))
#define PRESENT_IS_DARK(column, line)   ((column) == (line) + 1u)
#define PRESENT_NO_LINE                 0xfffffff0u

/* Placement of the image in the window. The vertex shader computes the texture coordinates, which
 * saves a third of the scaling pass's time on lavapipe. */
struct present_push {
    vec2s uv_from_clip; /* uv per unit of clip space */
    vec2s uv_of_center; /* texture coordinates at the centre of the window */
    uint32_t x, y;      /* position of the image's first pixel in the window */
};

#endif
