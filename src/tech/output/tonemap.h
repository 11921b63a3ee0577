/* tonemap.h: tone mapping of the linear HDR image to 8-bit sRGB. */
#ifndef FIRN_TECH_OUTPUT_TONEMAP_H
#define FIRN_TECH_OUTPUT_TONEMAP_H
#include "src/tech/technique.h"

struct tonemap_params {
    float exposure;  /* stops */
    uint32_t curve;  /* TONEMAP_NEUTRAL, ... */
    uint32_t dither; /* 1: dither 8-bit PNG files */
};

extern const struct setting_group tonemap_settings;

#endif
