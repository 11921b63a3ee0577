/* ice_normal.h: G-buffers of the ice's front and back faces. */
#ifndef FIRN_TECH_ICE_ICE_NORMAL_H
#define FIRN_TECH_ICE_ICE_NORMAL_H
#include "src/tech/technique.h"

/* xyz: outward unit normal of the back face, world space; w: 1, or 0 if there is no back face */
extern const struct rg_image ice_normal_back;

extern const struct rg_image ice_normal_front; /* as ice_normal_back; faces the camera */

/* xyz: bump-mapped normal of the front face; w: Fresnel reflectance by eq. 4 of the paper,
 * interpolated from the vertices. Undefined where there is no front face. */
extern const struct rg_image ice_normal_shading;

/* rgb: tinted transmittance of the front or back surface, or 1 without a face; a: roughness. Only
 * drawn if technique_config.is_textured. */
extern const struct rg_image ice_normal_front_material, ice_normal_back_material;

/* Radiance of the opaque base at front faces. Only drawn if technique_config.is_textured. */
extern const struct rg_image ice_normal_front_base;

/* Depth of the faces: near-plane distance / distance, or 0 if there is no face. */
extern const struct rg_image ice_normal_back_depth, ice_normal_front_depth;

/* G-buffers of an area 1.5 times as wide and high as the image, if technique_config.is_wide. Rays
 * inside an object that extends beyond the image read them. */
#define ICE_NORMAL_WIDE 1.5f
extern const struct rg_image ice_normal_wide_back, ice_normal_wide_front;
extern const struct rg_image ice_normal_wide_back_depth, ice_normal_wide_front_depth;

#endif
