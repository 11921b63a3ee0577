/* tonemap.h: converts the linear picture to 8 bits, sRGB, for displays. */
#ifndef TECH_TONEMAP_H
#define TECH_TONEMAP_H
#include "src/tech/technique.h"

struct tonemap_params {
    float exposure;  /* stops */
    uint32_t curve;  /* TONEMAP_NEUTRAL ... */
    uint32_t dither; /* 1: PNG files of 8 bits have noise of one step, which hides bands */
};

extern const struct setting_group tonemap_settings;

#endif
