/*
 * image_based_lighting.h: makes tables for image-based lighting (shaders/brdf.h) from an
 * equirectangular environment. The tables hold diffuse irradiance, and radiance prefiltered by
 * direction and roughness. The split-sum approximation (Karis 2013) assumes a view along the
 * normal. Shaders apply environment.turn at lookup.
 */
#ifndef FIRN_SCENE_ENVIRONMENT_IMAGE_BASED_LIGHTING_H
#define FIRN_SCENE_ENVIRONMENT_IMAGE_BASED_LIGHTING_H

#include "src/scene/environment/environment.h"

/* Returns the split-sum BRDF table: LIT_SPLIT_SIDE x LIT_SPLIT_SIDE pairs of half floats. The
 * caller frees the table. Returns NULL when out of memory. */
uint16_t *image_based_lighting_brdf_table(void);

/* Returns the prefiltered environment: LIT_LAYERS images of LIT_WIDTH x LIT_HEIGHT half RGBA
 * texels. The caller frees the array. Returns NULL when out of memory. */
uint16_t *image_based_lighting_prefilter(const struct environment *environment);

/* Returns the cone that most light comes from. xyz is the unit axis, rotated by environment.turn. w
 * is the cosine of the half-angle. If no light dominates or `table` is NULL, returns (0, 0, 0, 1).
 * `table` is the result of image_based_lighting_prefilter(). */
vec4s image_based_lighting_dominant_cone(const struct environment *environment,
                                         const uint16_t *table);

#endif
