/* present.h: what present.c, present.vert and present.frag agree on. */
#ifndef SHADERS_PRESENT_H
#define SHADERS_PRESENT_H
#include "abi.h"

#define PRESENT_PICTURE 0

/* Between two pictures lies a line of two columns, so that one of them shows on any ground. */
#define PRESENT_IS_BRIGHT(column, line) ((column) == (line))
#define PRESENT_IS_DARK(column, line)   ((column) == (line) + 1u)
#define PRESENT_NO_LINE                 0xfffffff0u

struct present_push {
    uint32_t encodes; /* 1: what is written to the window is sRGB-encoded after the shader */
    uint32_t line;    /* column of the window where it begins; PRESENT_NO_LINE: one picture */
    float left;       /* edge of what is drawn, clip space */
};

#endif
