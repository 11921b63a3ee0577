/* frame_cloud.h: density fields of a scene's scattering media, scaled by the settings. */
#ifndef FIRN_TECH_FRAME_CLOUD_H
#define FIRN_TECH_FRAME_CLOUD_H

#include "shaders/cloud.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

/* Returns the transform and extinction of field `index` of scene->clouds. */
struct cloud_place frame_cloud_at(const struct scene *scene, const struct settings *settings,
                                  uint32_t index);

/* Returns the density field of an object; its extinction is 0 if it has none. */
struct cloud_place frame_cloud_of(const struct scene *scene, const struct settings *settings,
                                  uint32_t object);

/* Returns true if any object contains a scattering medium. */
bool frame_has_cloud(const struct scene *scene, const struct settings *settings);

#endif
