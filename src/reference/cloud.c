/* cloud.c: free paths and directions of light in cloudy ice. */
#include "src/reference/cloud.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/cloud.h"
#include "src/reference/microfacet.h"
#include "src/tech/air.h"

struct cloud cloud_of(const struct radiance *radiance, const struct settings *settings)
{
    const struct air_params *params = settings_of(settings, &air_settings);
    const struct depth_field *field = &radiance->scene->depth;
    const vec3s sides = glms_vec3_sub(field->box.max, field->box.min);
    struct cloud cloud = { .field = field, .anisotropy = params->anisotropy };
    if (!air_is_medium(settings) || !(field->most > 0.0f))
        return cloud;
    cloud.object_from_world = glms_mat4_inv(radiance->globals->world_from_object);
    cloud.most = params->density / glms_vec3_max(sides);
    return cloud;
}

float cloud_density(const struct cloud *cloud, vec3s point)
{
    const vec3s at = glms_mat4_mulv3(cloud->object_from_world, point, 1.0f);
    return cloud->most * cloud_share(depth_field_at(cloud->field, at));
}

bool cloud_scatters(const struct cloud *cloud, const struct cloud_way *way, uint32_t sample,
                    uint32_t seed, float *distance)
{
    *distance = 0.0f;
    for (uint32_t step = 0;; step++) {
        const vec2s at = microfacet_point(sample, microfacet_hash(seed, step));
        *distance -= logf(1.0f - at.x) / cloud->most;
        if (!(*distance < way->length))
            return false;
        const vec3s point = glms_vec3_muladds(way->dir, *distance, way->from);
        if (at.y * cloud->most < cloud_density(cloud, point))
            return true;
    }
}

vec3s cloud_turned(const struct cloud *cloud, vec3s dir, vec2s at)
{
    const float g = cloud->anisotropy;
    const float u = 2.0f * at.x - 1.0f;
    const float k = (1.0f - g * g) / (1.0f + g * u);
    const float cosine =
        fabsf(g) < 1e-3f ? u : glm_clamp((1.0f + g * g - k * k) / (2.0f * g), -1.0f, 1.0f);
    const float sine = sqrtf(1.0f - cosine * cosine);
    const float angle = 6.28318531f * at.y;
    vec3s x, y;
    microfacet_tangents(dir, &x, &y);
    const vec3s across = glms_vec3_add(glms_vec3_scale(x, sine * cosf(angle)),
                                       glms_vec3_scale(y, sine * sinf(angle)));
    return glms_vec3_normalize(glms_vec3_muladds(dir, cosine, across));
}
