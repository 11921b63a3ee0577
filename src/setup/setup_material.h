/* setup_material.h: settings that a material preset sets for a scene's objects. */
#ifndef FIRN_SETUP_SETUP_MATERIAL_H
#define FIRN_SETUP_SETUP_MATERIAL_H

#include "src/scene/material_presets.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

/* Width of the real object that a built-in scene's object stands for, metres. */
#define SETUP_BUILTIN_WIDTH 0.028f

/* Returns the factor on absorption coefficients for the scene's objects: 1 for files, which are in
 * metres. Objects of built-in scenes stand for objects of width SETUP_BUILTIN_WIDTH. */
float setup_absorption_scale(const char *name, const struct scene *scene);

/* Sets a choice's refractive index and, if it has any, its dispersion, absorption, roughness and
 * scattering medium, with settings_put(). */
void setup_put_material(struct settings *settings, const struct material_choice *choice,
                        float absorption_scale, enum setting_source source);

/* Sets all settings of a material to those of a choice, with the user as their source. */
void setup_set_material(struct settings *settings, const struct material_choice *choice,
                        float absorption_scale);

struct material_override;

/* Fills the material override of a node and its --material text: the preset, followed by index,
 * roughness and dispersion of `material` where they differ from those of the preset. */
void setup_make_override(struct material_override *made, const char *node,
                         const struct material_choice *choice, const struct material *material);

/* Returns the preset whose settings these are, apart from the roughness; NULL if there is none. */
const struct material_preset *setup_find_material(const struct settings *settings,
                                                  float absorption_scale);

/* Returns the mean thickness of the walls of an object, twice its volume per surface area; 0 if it
 * has no triangles. A solid sphere of diameter d has d / 3. */
float setup_wall_thickness(const struct mesh *mesh, uint32_t first_index, uint32_t index_count);

/* Returns true if the walls of the scene's only object are too thin for bubbles and cracks. */
bool setup_has_thin_walls(const struct scene *scene);

#endif
