/* material_layout.h: layout of the material texture, which src/scene/gpu_material_table.c writes:
 * one row per material, four floats per texel. Row 0 is for vertices without material. */
#ifndef SHADERS_MATERIAL_LAYOUT_H
#define SHADERS_MATERIAL_LAYOUT_H

#define MATERIAL_ROW_FACTORS  0 /* metallic, roughness, specular, alpha */
#define MATERIAL_ROW_F0       1 /* rgb: dielectric reflectance at normal incidence; a: alpha mode */
#define MATERIAL_ROW_EMISSION 2 /* rgb: emission; a: alpha cutoff */
/* x: normal scale; y: occlusion strength; z: 1 for textured ice; w: 1 for a water layer */
#define MATERIAL_ROW_SCALES 3
/* Index of the first of two texels per texture. The first texel holds the transform of u, and array
 * layer + 1. The second holds the transform of v, and 9 * uv_set + 3 * wrap_v + wrap_u. */
#define MATERIAL_ROW_TEXTURES 4
#define MATERIAL_ROW_WIDTH    22

/* alpha modes */
#define MATERIAL_KIND_OPAQUE  0
#define MATERIAL_KIND_CUTOUT  1
#define MATERIAL_KIND_BLENDED 2

/* values of enum material_texture_use and enum material_wrap in src/scene/material.h */
#define MATERIAL_USE_BASE_COLOR         0
#define MATERIAL_USE_METALLIC_ROUGHNESS 1
#define MATERIAL_USE_NORMAL             2
#define MATERIAL_USE_OCCLUSION          3
#define MATERIAL_USE_EMISSION           4
#define MATERIAL_USE_TRANSMISSION       5
#define MATERIAL_USE_SPECULAR           7
#define MATERIAL_USE_SPECULAR_COLOR     8
#define MATERIAL_WRAPS_REPEAT           0
#define MATERIAL_WRAPS_MIRROR           1
#define MATERIAL_WRAPS_COUNT            3
#define MATERIAL_OTHER_SET              9

#define MATERIAL_ROUGH 0.6f /* minimum roughness without screen-space reflections */

#endif
