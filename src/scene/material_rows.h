/* material_rows.h: the materials of a scene as shaders read them (shaders/material.h). */
#ifndef FIRN_SCENE_MATERIAL_ROWS_H
#define FIRN_SCENE_MATERIAL_ROWS_H

#include "src/scene/import/model.h"

/* Returns the reflectance of a dielectric at normal incidence, without its texture; not clamped. */
vec3s material_f0(const struct material *material);

/* Returns the rows, malloc'd: one for vertices without a material, and one of each material. NULL
 * when out of memory. */
vec4s *material_rows_make(const struct model *model);

/* Returns what materials have textures of: bit i for enum material_texture_use i. */
uint32_t material_rows_uses(const struct model *model);

/* Whether some material is cut out or blended. */
bool material_rows_has_holes(const struct model *model);

/* Returns the extras of a mesh that has some as vertex shaders read them (shaders/mesh.h),
 * malloc'd: rows of MESH_EXTRA_WIDTH texels. NULL when out of memory. */
vec4s *material_rows_make_extras(const struct mesh *mesh);

/* Returns whether light falls on any triangle, which is not so if all are unlit. */
bool material_rows_has_lit(const struct mesh *mesh);

/* Returns whether surroundings have a surface that may be smooth enough for an image of what is
 * near it. */
bool material_rows_has_mirrors(const struct model *model);

/* Returns whether surroundings have a surface that is more than a matt one of one texture that
 * repeats. */
bool material_rows_has_rich(const struct model *model);

#endif
