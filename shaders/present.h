/* present.h: shared by present.c, its shaders and overlay.frag. */
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

struct present_push {
    uint32_t
        line; /* first column of the line, from the picture's left; PRESENT_NO_LINE: one picture */
    uint32_t x, y;                      /* of the shown picture in the window, pixels */
    uint32_t width, height;             /* as it is shown, pixels */
    uint32_t texel_columns, texel_rows; /* as it was drawn */
    vec2s part;                         /* of the shown picture is a pixel of the window */
    uint32_t surround;                  /* what is around it, 0xRRGGBB, sRGB-encoded */
};

#endif
