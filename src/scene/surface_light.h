/*
 * surface_light.h: image-based lighting tables of an equirectangular environment (shaders/lit.h).
 *
 * Prefiltered radiance per direction and roughness (Karis 2013, split-sum approximation, view along
 * the normal), and diffuse irradiance. The tables ignore environment.turn; lookups apply it.
 */
#ifndef FIRN_SCENE_SURFACE_LIGHT_H
#define FIRN_SCENE_SURFACE_LIGHT_H

#include "src/scene/environment.h"

/* Returns the split-sum BRDF table: LIT_SPLIT_SIDE x LIT_SPLIT_SIDE pairs of half floats. The
 * caller frees it. NULL when out of memory. */
uint16_t *surface_split_make(void);

/* Returns the prefiltered environment: LIT_LAYERS images of LIT_WIDTH x LIT_HEIGHT texels, half
 * RGBA. The caller frees it. NULL when out of memory. */
uint16_t *surface_light_make(const struct environment *environment);

/* Returns the cone that most light comes from: xyz is the unit axis, rotated by environment.turn,
 * and w the cosine of the half-angle. (0, 0, 0, 1) if nothing is much brighter than the mean.
 * `table` is the result of surface_light_make(), or NULL. */
vec4s surface_light_guide(const struct environment *environment, const uint16_t *table);

#endif
