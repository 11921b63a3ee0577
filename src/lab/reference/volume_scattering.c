/* volume_scattering.c: delta tracking and Henyey-Greenstein sampling in density fields. */
#include "src/lab/reference/volume_scattering.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/microfacet.h"
#include "src/tech/inclusions/air.h"
#include "src/tech/inclusions/medium_density_fields.h"

enum {
    SUN_STEPS = 32, /* ray marching steps towards the sun */
};

struct volume_scattering volume_scattering_of(const struct radiance *radiance,
                                              const struct settings *settings, uint32_t index)
{
    const struct air_params *params = settings_of(settings, &air_settings);
    const struct scattering_media *fields = &radiance->scene->inclusions.media;
    return (struct volume_scattering){
        .fields = fields,
        .index = index,
        .object = fields->all[index].object,
        .object_from_world = glms_mat4_inv(radiance->globals->world_from_object),
        .majorant = medium_field_at(radiance->scene, settings, index).extinction,
        .anisotropy = params->anisotropy,
    };
}

float volume_scattering_extinction(const struct volume_scattering *volume_scattering, vec3s point)
{
    const vec3s at = glms_mat4_mulv3(volume_scattering->object_from_world, point, 1.0f);
    return volume_scattering->majorant *
           scattering_media_at(volume_scattering->fields, volume_scattering->index, at);
}

float volume_scattering_sun_depth(const struct volume_scattering *volume_scattering, vec3s point,
                                  vec3s to_sun)
{
    const struct box box = volume_scattering->fields->all[volume_scattering->index].box;
    const float step = box_diagonal(box) / SUN_STEPS;
    float sum = 0.0f;
    for (int i = 0; i < SUN_STEPS; i++)
        sum += step *
               volume_scattering_extinction(
                   volume_scattering, glms_vec3_muladds(to_sun, step * ((float)i + 0.5f), point));
    return sum;
}

bool volume_scattering_sample_distance(const struct volume_scattering *volume_scattering,
                                       const struct volume_scattering_segment *segment,
                                       uint32_t sample, uint32_t seed, float *distance)
{
    *distance = 0.0f;
    for (uint32_t step = 0;; step++) {
        const vec2s at = microfacet_point(sample, microfacet_hash(seed, step));
        *distance -= logf(1.0f - at.x) / volume_scattering->majorant;
        if (!(*distance < segment->length))
            return false;
        const vec3s point = glms_vec3_muladds(segment->dir, *distance, segment->from);
        if (at.y * volume_scattering->majorant <
            volume_scattering_extinction(volume_scattering, point))
            return true;
    }
}

vec3s volume_scattering_sample_direction(const struct volume_scattering *volume_scattering,
                                         vec3s dir, vec2s at)
{
    const float g = volume_scattering->anisotropy;
    const float u = 2.0f * at.x - 1.0f;
    const float k = (1.0f - g * g) / (1.0f + g * u);
    const float cosine =
        fabsf(g) < 1e-3f ? u : glm_clamp((1.0f + g * g - k * k) / (2.0f * g), -1.0f, 1.0f);
    const float sine = sqrtf(1.0f - cosine * cosine);
    const float angle = 6.28318531f * at.y;
    const struct microfacet_tangents t = microfacet_tangents_of(dir);
    const vec3s across = glms_vec3_add(glms_vec3_scale(t.x, sine * cosf(angle)),
                                       glms_vec3_scale(t.y, sine * sinf(angle)));
    return glms_vec3_normalize(glms_vec3_muladds(dir, cosine, across));
}
