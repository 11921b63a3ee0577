/* material_rows.h: GPU table of a scene's materials (shaders/material.h). */
#ifndef FIRN_SCENE_MATERIAL_ROWS_H
#define FIRN_SCENE_MATERIAL_ROWS_H

#include "src/scene/import/model.h"

/* Returns a dielectric's reflectance at normal incidence (F0), without textures; not clamped. */
vec3s material_f0(const struct material *material);

/* Returns the GPU table: a row for vertices without a material, then one for each material. The
 * caller frees it. NULL when out of memory. */
vec4s *material_rows_make(const struct model *model);

/* Returns the texture uses that occur: bit i for enum material_texture_use i. */
uint32_t material_rows_uses(const struct model *model);

/* Returns true if any material is alpha-masked or blended. */
bool material_rows_has_holes(const struct model *model);

/* Returns the GPU table of a mesh's vertex extras (shaders/mesh.h), in rows of MESH_EXTRA_WIDTH
 * texels. The caller frees it. NULL if there are none, or when out of memory. */
vec4s *material_rows_make_extras(const struct mesh *mesh);

/* Returns true if any vertex is lit, that is, not MESH_UNLIT. */
bool material_rows_has_lit(const struct mesh *mesh);

/* Returns true if a surface of the surroundings may be smooth enough for screen-space reflections.
 */
bool material_rows_has_mirrors(const struct model *model);

/* Returns true if a material of the surroundings needs more than a repeating diffuse texture. */
bool material_rows_has_rich(const struct model *model);

#endif
