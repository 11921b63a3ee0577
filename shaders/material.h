/*
 * material.h: the texture that holds the materials of surfaces, a row each, of four floats a texel;
 * the first row is for vertices without a material. Written by src/scene/material_rows.c.
 */
#ifndef SHADERS_MATERIAL_H
#define SHADERS_MATERIAL_H

#define MATERIAL_ROW_FACTORS  0 /* metallic, roughness, specular, alpha */
#define MATERIAL_ROW_F0       1 /* reflectance of a dielectric at normal incidence, rgb; kind */
#define MATERIAL_ROW_EMISSION 2 /* rgb; alpha cutoff */
#define MATERIAL_ROW_SCALES   3 /* of the normal's slopes, of the occlusion; 1: dressed; 1: film */
#define MATERIAL_ROW_TEXTURES \
    4 /* two texels each of enum material_texture_use: the row of u and
                                   layer + 1; the row of v and
                                   9 * uv_set + 3 * wrap_v + wrap_u */
#define MATERIAL_ROW_WIDTH 22

/* kinds */
#define MATERIAL_KIND_OPAQUE  0
#define MATERIAL_KIND_CUTOUT  1
#define MATERIAL_KIND_BLENDED 2

/* enum material_texture_use and enum material_wrap of src/scene/material.h */
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

#define MATERIAL_ROUGH 0.6f /* roughness from which on a surface mirrors no objects */

#endif
