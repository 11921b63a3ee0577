/* tonemap.h: tone mapping of the linear HDR image to 8-bit sRGB. */
#ifndef FIRN_TECH_OUTPUT_TONEMAP_H
#define FIRN_TECH_OUTPUT_TONEMAP_H
#include "shaders/output/tonemap.h"
#include "src/tech/technique.h"

struct tonemap_values {
    float exposure;   /* stops */
    uint32_t curve;   /* TONEMAP_NEUTRAL, ... */
    uint32_t dither;  /* 1: dither 8-bit PNG files */
    uint32_t resolve; /* TONEMAP_RESOLVE_WEIGHTED, ... */
};

extern const struct setting_group tonemap_settings;

/* Returns the tone mapping parameters for the shader and for tonemap_apply(). All outputs use this
 * function, because each setting must have an equal effect on all outputs. */
struct tonemap_params tonemap_params_of(const struct settings *settings);

/* Returns true if two sets of parameters give the same image. */
bool tonemap_params_equal(const struct tonemap_params *a, const struct tonemap_params *b);

#endif
