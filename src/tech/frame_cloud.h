/* frame_cloud.h: the clouds of a scene (shaders/cloud.h), where settings say how dense they are.
 */
#ifndef FIRN_TECH_FRAME_CLOUD_H
#define FIRN_TECH_FRAME_CLOUD_H

#include "shaders/cloud.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

/* Returns where the densities of a cloud of scene->clouds are, and how dense it is. */
struct cloud_place frame_cloud_at(const struct scene *scene, const struct settings *settings,
                                  uint32_t index);

/* Returns the cloud of an object; without one, its extinction is 0. */
struct cloud_place frame_cloud_of(const struct scene *scene, const struct settings *settings,
                                  uint32_t object);

/* Returns whether an object is cloudy. */
bool frame_has_cloud(const struct scene *scene, const struct settings *settings);

#endif
