/* ice_normal.h: normals and depth of the ice's back and front faces as the eye sees them. */
#ifndef TECH_ICE_NORMAL_H
#define TECH_ICE_NORMAL_H
#include "src/tech/technique.h"

/* xyz: outward unit normal, world, which points away from the eye; w: 1, or 0 without a face */
extern const struct rg_image ice_normal_back;

extern const struct rg_image ice_normal_front; /* as ice_normal_back; points towards the eye */

/* Where there are front faces, xyz: their normal with bumps; w: eq. 4 of the paper, interpolated
 * from the vertices. Undefined elsewhere. */
extern const struct rg_image ice_normal_shading;

/* If technique_choice.is_dressed, of front and of back faces, rgb: the share of light that passes,
 * tinted; a: the roughness. Without a face 1, 1, 1. */
extern const struct rg_image ice_normal_dress_front, ice_normal_dress_back;

/* Radiance of what a front face neither reflects nor lets pass, likewise. */
extern const struct rg_image ice_normal_dress_shine;

/* Their depth by globals.clip_from_world: near plane over distance; 0 without a face. */
extern const struct rg_image ice_normal_back_depth, ice_normal_front_depth;

/*
 * The same of an area that is larger than the picture to all sides, by globals.wide_share, if
 * technique_choice.is_wide: faces beyond the picture's edges, for rays inside the object.
 */
#define ICE_NORMAL_WIDE 1.5f
extern const struct rg_image ice_normal_wide_back, ice_normal_wide_front;
extern const struct rg_image ice_normal_wide_back_depth, ice_normal_wide_front_depth;

#endif
