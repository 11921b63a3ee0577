/* frame_cloud.c: looks up the density fields of a scene's scattering media. */
#include "src/tech/frame_cloud.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/tech/air.h"

struct cloud_place frame_cloud_at(const struct scene *scene, const struct settings *settings,
                                  uint32_t index)
{
    const struct air_params *params = settings_of(settings, &air_settings);
    const struct cloud_field *cloud = &scene->clouds.all[index];
    const vec3s sides = glms_vec3_sub(cloud->box.max, cloud->box.min);
    const vec3s texels = { { CLOUD_SIZE, CLOUD_SIZE, CLOUD_SIZE } };
    const float own = cloud->density * params->clouds;
    const float density = cloud->density > 0.0f     ? own
                          : air_is_medium(settings) ? params->density
                                                    : 0.0f;
    return (struct cloud_place){
        .low = cloud->box.min,
        .extinction = density / fmaxf(glms_vec3_max(sides), 1e-20f),
        .texels_each = glms_vec3_div(texels, sides),
        .first_layer = (float)(CLOUD_SIZE * index),
        .from = cloud->filled.min,
        .to = cloud->filled.max,
    };
}

struct cloud_place frame_cloud_of(const struct scene *scene, const struct settings *settings,
                                  uint32_t object)
{
    for (uint32_t i = 0; i < scene->clouds.count; i++) {
        if (scene->clouds.all[i].object == object)
            return frame_cloud_at(scene, settings, i);
    }
    return (struct cloud_place){ .extinction = 0.0f };
}

bool frame_has_cloud(const struct scene *scene, const struct settings *settings)
{
    for (uint32_t i = 0; i < scene->clouds.count; i++) {
        if (frame_cloud_at(scene, settings, i).extinction > 0.0f)
            return true;
    }
    return false;
}
