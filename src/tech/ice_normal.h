/* ice_normal.h: the ice's back and front faces as the view sees them: normals and depth. */
#ifndef TECH_ICE_NORMAL_H
#define TECH_ICE_NORMAL_H
#include "src/tech/technique.h"

/* xyz: outward, unit, world: away from the eye, never flipped; w: 1, or 0 where there is none */
extern const struct rg_image ice_normal_back;

extern const struct rg_image ice_normal_front; /* the same, towards the eye */

/* Where there are front faces, xyz: their normal, as bumps bend it; w: SN eq. 4, from the vertices.
 * Elsewhere undefined. */
extern const struct rg_image ice_normal_shading;

/* Their depth by globals.clip_from_world: near over the distance; 0 where there is none. */
extern const struct rg_image ice_normal_back_depth, ice_normal_front_depth;

#endif
