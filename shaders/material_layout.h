/* material_layout.h: layout of the material texture, which src/scene/gpu_material_table.c writes.
 * Each row is a material. Each texel has four floats. Row 0 is for vertices without material. */
#ifndef SHADERS_MATERIAL_LAYOUT_H
#define SHADERS_MATERIAL_LAYOUT_H
#include "abi_math.h"

#define MATERIAL_ROW_FACTORS  0 /* metallic, roughness, specular, alpha */
#define MATERIAL_ROW_F0       1 /* rgb: dielectric reflectance at normal incidence; a: alpha mode */
#define MATERIAL_ROW_EMISSION 2 /* rgb: emission (tint if z below exceeds 1); a: alpha cutoff */
/* x: normal scale; y: occlusion strength; z: 1 for textured ice, 2 + opacity for one of several
 * materials of an object; w: 1 for a water layer */
#define MATERIAL_ROW_SCALES 3
/* x: clear coat factor; y: its roughness; z: 1 for a shadow catcher */
#define MATERIAL_ROW_COAT 4
/* First texel of the row's texture data. Each texture has two texels: the transform of u and array
 * layer + 1, then the transform of v and 9 * uv_set + 3 * wrap_v + wrap_u. */
#define MATERIAL_ROW_TEXTURES 5
#define MATERIAL_ROW_WIDTH    (MATERIAL_ROW_TEXTURES + 2 * MATERIAL_TEXTURE_COUNT)

/* alpha modes */
#define MATERIAL_KIND_OPAQUE  0
#define MATERIAL_KIND_CUTOUT  1
#define MATERIAL_KIND_BLENDED 2

/* Uses of textures. Comments name texture channels, and the material parameters they affect. */
#define MATERIAL_BASE_COLOR         0  /* rgb: base_color; a: alpha */
#define MATERIAL_METALLIC_ROUGHNESS 1  /* b: metallic; g: roughness */
#define MATERIAL_NORMAL             2  /* rgb: normal */
#define MATERIAL_OCCLUSION          3  /* r */
#define MATERIAL_EMISSION           4  /* rgb: emission */
#define MATERIAL_TRANSMISSION       5  /* r: transmission */
#define MATERIAL_THICKNESS          6  /* g: thickness */
#define MATERIAL_SPECULAR           7  /* a: specular */
#define MATERIAL_SPECULAR_COLOR     8  /* rgb: specular_color */
#define MATERIAL_COAT               9  /* r: coat */
#define MATERIAL_COAT_ROUGHNESS     10 /* g: coat_roughness */
#define MATERIAL_TEXTURE_COUNT      11

/* wrapping of texture coordinates outside 0 to 1 */
#define MATERIAL_REPEAT     0
#define MATERIAL_MIRROR     1
#define MATERIAL_CLAMP      2
#define MATERIAL_WRAP_COUNT 3
#define MATERIAL_OTHER_SET  (MATERIAL_WRAP_COUNT * MATERIAL_WRAP_COUNT)

#define MATERIAL_ROUGH 0.6f /* minimum roughness without screen-space reflections */

/* Applies a wrap mode to a texture coordinate. `size` is the texture's width in texels.
 * MATERIAL_REPEAT is left to the sampler. Other modes clamp to the centres of the edge texels. */
ABI_FUNCTION float material_wrap(float x, uint32_t mode, float size)
{
    if (mode == MATERIAL_REPEAT)
        return x;
    if (mode == MATERIAL_MIRROR)
        x = 1.0f - fabsf(1.0f - 2.0f * (0.5f * x - floorf(0.5f * x)));
    return glm_clamp(x, 0.5f / size, 1.0f - 0.5f / size);
}

#endif
