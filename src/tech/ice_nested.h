/*
 * ice_nested.h: faces of bodies that are in other bodies: objects in objects, and cavities.
 *
 * Level 0 is between the nearest and the farthest face that a pixel sees; the next level is
 * between the nearest and the farthest face of those that are between the two, and so on.
 */
#ifndef TECH_ICE_NESTED_H
#define TECH_ICE_NESTED_H
#include "shaders/ice_nested.h"
#include "src/tech/technique.h"

/* Layers: near and far face of level 0, of level 1, and so on. Depth by globals.clip_from_world, as
 * that of ice_normal.h. Of normals, xyz: unit, world, away from the level; w: 1 + the medium in the
 * level at this face, or 0 without a face. */
extern const struct rg_image ice_nested_depths, ice_nested_normals;

/* The same of the wider area of ice_normal.h, if technique_choice.is_wide. */
extern const struct rg_image ice_nested_wide_depths, ice_nested_wide_normals;

extern const struct rg_buffer ice_nested_media; /* struct ice_nested_media */

/* Whether there are objects in others. */
bool ice_nested_is_in(const struct scene *scene);

/* Whether there are no more media than the maps can tell apart. */
bool ice_nested_fits(const struct scene *scene);

/* Returns the number of objects that are within no other one. */
uint32_t ice_nested_outermost_count(const struct scene *scene);

#endif
