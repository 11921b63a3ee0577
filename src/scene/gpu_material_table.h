/* gpu_material_table.h: GPU table of a scene's materials (shaders/material_layout.h). */
#ifndef FIRN_SCENE_GPU_MATERIAL_TABLE_H
#define FIRN_SCENE_GPU_MATERIAL_TABLE_H

#include "src/scene/import/model.h"

/* Returns a dielectric's unclamped reflectance at normal incidence (F0), without textures. */
vec3s material_f0(const struct material *material);

/* Returns the GPU table of materials, or NULL when out of memory. Row i + 1 is material i. Row 0 is
 * for vertices without a material. The caller frees the table. */
vec4s *material_table_make(const struct model *model);

/* Returns the texture uses of a model. Bit i stands for use i, such as MATERIAL_BASE_COLOR. */
uint32_t material_table_uses(const struct model *model);

/* Returns true if any material is alpha-masked or blended. */
bool material_table_has_holes(const struct model *model);

/* Returns true if any opaque material has a clear coat. */
bool material_table_has_coat(const struct model *model);

/* Returns true if any material is a shadow catcher. */
bool material_table_has_shadow_catcher(const struct model *model);

/* Returns the GPU table of a mesh's vertex extras (shaders/mesh_layout.h). Each row has
 * MESH_EXTRA_WIDTH texels. If the mesh has no extras, or if out of memory, returns NULL. The caller
 * frees the table. */
vec4s *material_table_make_extras(const struct mesh *mesh);

/* Returns true if lighting affects any vertex, that is, if a vertex lacks the flag MESH_UNLIT. */
bool material_table_has_lit(const struct mesh *mesh);

/* Returns true if any surroundings surface may be smooth enough for screen-space reflections. */
bool material_table_has_reflective(const struct model *model);

/* Returns true if a material of the surroundings needs more than a repeating diffuse texture. */
bool material_table_needs_full_shading(const struct model *model);

#endif
