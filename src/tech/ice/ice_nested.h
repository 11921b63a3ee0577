/*
 * ice_nested.h: depth layers of nested objects and cavities.
 *
 * Level 0 lies between a pixel's nearest and farthest face; each further level lies between the
 * nearest and the farthest of the faces strictly inside the previous one.
 */
#ifndef FIRN_TECH_ICE_ICE_NESTED_H
#define FIRN_TECH_ICE_ICE_NESTED_H
#include "shaders/ice/ice_nested.h"
#include "src/tech/technique.h"

/* Image layers: near and far face of level 0, then of level 1, and so on. Depth is by
 * globals.clip_from_world, as in ice_normal.h. Normals: xyz: unit, world, pointing out of the
 * level; w: 1 + medium in the level at this face, or 0 if there is no face. */
extern const struct rg_image ice_nested_depths, ice_nested_normals;

/* Depth layers of the area that extends beyond the image, if technique_config.is_wide. */
extern const struct rg_image ice_nested_wide_depths, ice_nested_wide_normals;

extern const struct rg_buffer ice_nested_media; /* struct ice_nested_media */

/* Returns true if objects are nested in others. */
bool ice_nested_is_in(const struct scene *scene);

/* Returns true if the number of media is within the limit of the maps. */
bool ice_nested_fits(const struct scene *scene);

/* Returns the number of objects that are not nested in another one. */
uint32_t ice_nested_outermost_count(const struct scene *scene);

#endif
