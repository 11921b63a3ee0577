/* present.h: what present.c and present.frag agree on. */
#ifndef SHADERS_PRESENT_H
#define SHADERS_PRESENT_H
#include "abi.h"

#define PRESENT_PICTURE 0

struct present_push {
    uint32_t encodes; /* 1: what is written to the window is sRGB-encoded after the shader */
};

#endif
