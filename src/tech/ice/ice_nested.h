/*
 * ice_nested.h: depth layers of nested objects and cavities.
 *
 * Level 0 is the interval from a pixel's nearest face to its farthest face. Each further level is
 * the interval from the nearest to the farthest face strictly inside the previous level.
 */
#ifndef FIRN_TECH_ICE_ICE_NESTED_H
#define FIRN_TECH_ICE_ICE_NESTED_H
#include "shaders/ice/ice_nested.h"
#include "src/tech/technique.h"

/* Depth and normals of faces. Layer 2 i holds the near face of nesting level i. Layer 2 i + 1 holds
 * the far face. xyz: world-space unit normal that points out of the level; w: 1 + the index of the
 * medium just inside the face, or 0 in pixels without a face. */
extern const struct rg_image ice_nested_depths, ice_nested_normals;

/* Depth and normals of an area larger than the image. Drawn only if technique_config.is_wide. */
extern const struct rg_image ice_nested_wide_depths, ice_nested_wide_normals;

extern const struct rg_buffer ice_nested_media; /* struct ice_nested_media */

/* Returns true if the scene has nested objects. */
bool ice_nested_is_in(const struct scene *scene);

/* Returns true if the scene has at most ICE_NESTED_MEDIA_MAX media, the limit of this technique. */
bool ice_nested_fits(const struct scene *scene);

/* Returns the number of objects that are not nested in another one. */
uint32_t ice_nested_outermost_count(const struct scene *scene);

#endif
