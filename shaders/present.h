/* present.h: shared by present.c, its shaders, overlay.frag and picture_file.c. */
#ifndef SHADERS_PRESENT_H
#define SHADERS_PRESENT_H
#include "abi.h"

#define PRESENT_PICTURE 0

/* Id of the one specialization constant: 1: the window's format encodes what shaders write as sRGB.
 * On a push constant lavapipe would decode in every pixel of every window. */
#define PRESENT_ENCODES 0

/* Two pictures are separated by a bright and a dark column, one of which is visible anywhere. */
#define PRESENT_IS_BRIGHT(column, line) ((column) == (line))
#define PRESENT_IS_DARK(column, line)   ((column) == (line) + 1u)
#define PRESENT_NO_LINE                 0xfffffff0u

/* Where the picture is in the window; the vertex shader's coordinates make a third less of a pass
 * that scales on lavapipe than coordinates made in each pixel. */
struct present_push {
    vec2s uv_from_clip; /* factors of the picture's coordinates: 0, 0 and 1, 1 are its corners */
    vec2s uv_of_middle; /* those in the middle of the window */
    uint32_t x, y;      /* of the picture's first pixel in the window */
};

#endif
