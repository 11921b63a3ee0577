/*
 * image_based_lighting.h: tables for image-based lighting (shaders/brdf.h), made from an
 * equirectangular environment. They hold diffuse irradiance, and radiance prefiltered by direction
 * and roughness (split-sum approximation of Karis 2013, viewed along the normal). Shaders apply
 * environment.turn at lookup.
 */
#ifndef FIRN_SCENE_ENVIRONMENT_IMAGE_BASED_LIGHTING_H
#define FIRN_SCENE_ENVIRONMENT_IMAGE_BASED_LIGHTING_H

#include "src/scene/environment/environment.h"

/* Returns the split-sum BRDF table: LIT_SPLIT_SIDE x LIT_SPLIT_SIDE pairs of half floats. The
 * caller frees it. Returns NULL when out of memory. */
uint16_t *image_based_lighting_brdf_table(void);

/* Returns the prefiltered environment: LIT_LAYERS images of LIT_WIDTH x LIT_HEIGHT half RGBA
 * texels. The caller frees it. Returns NULL when out of memory. */
uint16_t *image_based_lighting_prefilter(const struct environment *environment);

/* Returns the cone that most light comes from: xyz is the unit axis, rotated by environment.turn; w
 * is the cosine of the half-angle. Returns (0, 0, 0, 1) if nothing is much brighter than the mean.
 * `table` is the result of image_based_lighting_prefilter(), or NULL. */
vec4s image_based_lighting_dominant_cone(const struct environment *environment,
                                         const uint16_t *table);

#endif
