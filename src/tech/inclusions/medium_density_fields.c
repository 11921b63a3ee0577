/* medium_density_fields.c: looks up the density fields of a scene's scattering media. */
#include "src/tech/inclusions/medium_density_fields.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/tech/inclusions/air.h"

struct medium_field medium_field_at(const struct scene *scene, const struct settings *settings,
                                    uint32_t index)
{
    const struct air_params *params = settings_of(settings, &air_settings);
    const struct scattering_medium *field = &scene->inclusions.media.all[index];
    const vec3s sides = glms_vec3_sub(field->box.max, field->box.min);
    const vec3s texels = { { MEDIUM_SIZE, MEDIUM_SIZE, MEDIUM_SIZE } };
    const float own = field->density * params->scattering_media;
    const float density = field->density > 0.0f     ? own
                          : air_is_medium(settings) ? params->density
                                                    : 0.0f;
    return (struct medium_field){
        .min_corner = field->box.min,
        .extinction = density / fmaxf(glms_vec3_max(sides), 1e-20f),
        .texels_per_metre = glms_vec3_div(texels, sides),
        .first_layer = (float)(MEDIUM_SIZE * index),
        .from = field->filled.min,
        .to = field->filled.max,
    };
}

struct medium_field medium_field_of(const struct scene *scene, const struct settings *settings,
                                    uint32_t object)
{
    for (uint32_t i = 0; i < scene->inclusions.media.count; i++) {
        if (scene->inclusions.media.all[i].object == object)
            return medium_field_at(scene, settings, i);
    }
    return (struct medium_field){ .extinction = 0.0f };
}

bool medium_field_exists(const struct scene *scene, const struct settings *settings)
{
    for (uint32_t i = 0; i < scene->inclusions.media.count; i++) {
        if (medium_field_at(scene, settings, i).extinction > 0.0f)
            return true;
    }
    return false;
}
