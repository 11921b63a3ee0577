/* medium_density_fields.h: density fields of a scene's scattering media, scaled by the settings. */
#ifndef FIRN_TECH_INCLUSIONS_MEDIUM_DENSITY_FIELDS_H
#define FIRN_TECH_INCLUSIONS_MEDIUM_DENSITY_FIELDS_H

#include "shaders/inclusions/medium_density.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

/* Returns the transform and extinction of field `index` of scene->inclusions.media. */
struct medium_field medium_field_at(const struct scene *scene, const struct settings *settings,
                                    uint32_t index);

/* Returns the density field of an object; its extinction is 0 if it has none. */
struct medium_field medium_field_of(const struct scene *scene, const struct settings *settings,
                                    uint32_t object);

/* Returns true if any object contains a scattering medium. */
bool medium_field_exists(const struct scene *scene, const struct settings *settings);

#endif
