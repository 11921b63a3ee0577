/* paint.h: what the test shaders that draw a rectangle are told. */
#ifndef PAINT_H
#define PAINT_H
#include "shaders/abi.h"

#define PAINT_SOURCE 3 /* what fetch.frag and halve.frag read */

struct paint_push {
    vec4s color;
    vec2s from, to; /* corners in clip space */
    float depth;
};

#endif
