/* tonemap.h: what tonemap.c and tonemap.frag agree on. */
#ifndef SHADERS_TONEMAP_H
#define SHADERS_TONEMAP_H
#include "abi.h"

#define TONEMAP_COLOR 0 /* linear picture */

#define TONEMAP_NEUTRAL 0 /* tonemap_params.curve */
#define TONEMAP_CLIP    1

struct tonemap_params {
    float exposure; /* stops */
    uint32_t curve; /* TONEMAP_NEUTRAL ... */
};

#endif
