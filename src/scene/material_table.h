/* material_table.h: GPU table of a scene's materials (shaders/material_layout.h). */
#ifndef FIRN_SCENE_MATERIAL_TABLE_H
#define FIRN_SCENE_MATERIAL_TABLE_H

#include "src/scene/import/model.h"

/* Returns a dielectric's reflectance at normal incidence (F0), without textures; not clamped. */
vec3s material_f0(const struct material *material);

/* Returns the GPU table, or NULL when out of memory. The first row is for vertices without a
 * material; one row per material follows. The caller frees the table. */
vec4s *material_table_make(const struct model *model);

/* Returns a model's texture uses as bits. Bit i is for use i of enum material_texture_use. */
uint32_t material_table_uses(const struct model *model);

/* Returns true if any material is alpha-masked or blended. */
bool material_table_has_holes(const struct model *model);

/* Returns the GPU table of a mesh's vertex extras (shaders/mesh_layout.h), in rows of
 * MESH_EXTRA_WIDTH texels. Returns NULL without extras or when out of memory. The caller frees the
 * table. */
vec4s *material_table_make_extras(const struct mesh *mesh);

/* Returns true if any vertex is lit, that is, not MESH_UNLIT. */
bool material_table_has_lit(const struct mesh *mesh);

/* Returns true if any surroundings surface may be smooth enough for screen-space reflections. */
bool material_table_has_reflective(const struct model *model);

/* Returns true if a material of the surroundings needs more than a repeating diffuse texture. */
bool material_table_needs_full_shading(const struct model *model);

#endif
