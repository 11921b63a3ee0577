/* ice_gbuffer.h: G-buffers of the ice's front and back faces. */
#ifndef FIRN_TECH_ICE_ICE_GBUFFER_H
#define FIRN_TECH_ICE_ICE_GBUFFER_H
#include "src/tech/technique.h"

/* World-space normals of the back faces. xyz: outward unit normal; w: 1, or 0 without a face. */
extern const struct rg_image ice_normal_back;

extern const struct rg_image ice_normal_front; /* as ice_normal_back; faces the camera */

/* Shading normals of the front faces. xyz: bump-mapped normal; w: Fresnel reflectance (Seipel and
 * Nivfors 2006, eq. 4). Pixels without a front face are undefined. */
extern const struct rg_image ice_normal_shading;

/* Surface materials. rgb: tinted transmittance, or 1 in pixels without a face; a: roughness. Drawn
 * only if ice_gbuffer_has_materials(). */
extern const struct rg_image ice_normal_front_material, ice_normal_back_material;

/* Radiance of the opaque base at front faces. Drawn only if ice_gbuffer_has_materials(). */
extern const struct rg_image ice_normal_front_base;

/* Reversed depth of the faces: near-plane distance / view-space depth, or 0 without a face. */
extern const struct rg_image ice_normal_back_depth, ice_normal_front_depth;

/* Factor by which wide G-buffers exceed the image in width and height. Rays inside an object that
 * extends beyond the image read wide G-buffers. Drawn only if technique_config.is_wide. */
#define ICE_NORMAL_WIDE 1.5f
extern const struct rg_image ice_normal_wide_back, ice_normal_wide_front;
extern const struct rg_image ice_normal_wide_back_depth, ice_normal_wide_front_depth;

/* Returns true if the G-buffers contain surface materials. They do if a raster refraction model
 * draws objects with textured or tinted surfaces and bump mapping is off. */
bool ice_gbuffer_has_materials(const struct technique_config *config);

#endif
