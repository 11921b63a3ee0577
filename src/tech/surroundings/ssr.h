/* ssr.h: screen-space reflections of the refractive objects in glossy surroundings. */
#ifndef FIRN_TECH_SURROUNDINGS_SSR_H
#define FIRN_TECH_SURROUNDINGS_SSR_H
#include "src/tech/technique.h"

/* Inputs of screen-space reflections (SURROUNDINGS_OUT_SURFACE and _SPECULAR). The surroundings'
 * passes write them. Undefined in pixels without materials. */
extern const struct rg_image ssr_surface, ssr_specular;

extern const struct setting_group ssr_settings;

struct ssr_params {
    uint32_t steps;   /* ray march steps; 0: no SSR */
    uint32_t refract; /* 1: refract reflected rays in objects */
};

/* Returns true if a frame draws screen-space reflections. */
bool ssr_is_drawn(const struct technique_config *config);

#endif
