/* punctual_light.c: validation of punctual lights, and their GPU table. */
#include "src/scene/punctual_light.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "shaders/brdf.h"

const char *punctual_light_kind_name(const struct light *light)
{
    static const char *const names[LIGHT_KIND_COUNT] = {
        [LIGHT_DIRECTIONAL] = "directional",
        [LIGHT_POINT] = "point",
        [LIGHT_SPOT] = "spot",
    };
    return names[light->kind];
}

/* Returns true if a value is in a range; false for NaN. */
static bool is_in_range(float value, float min, float max)
{
    return value >= min && value <= max;
}

bool punctual_light_is_valid(const struct light *light)
{
    const float far = 1e9f, half_pi = 1.5707964f;
    const bool is_spot = light->kind == LIGHT_SPOT;
    for (int k = 0; k < 3; k++) {
        if (!is_in_range(light->position.raw[k], -far, far) ||
            !is_in_range(light->color.raw[k], 0, 65504))
            return false;
    }
    return light->kind < LIGHT_KIND_COUNT && memchr(light->name, 0, sizeof(light->name)) &&
           is_in_range(glms_vec3_norm(light->direction), 0.999f, 1.001f) &&
           is_in_range(light->intensity, 0, 1e30f) && is_in_range(light->range, 0, 1e30f) &&
           light->inner_cone >= 0 && is_in_range(light->outer_cone, 0, half_pi) &&
           (is_spot ? light->inner_cone < light->outer_cone
                    : !(light->inner_cone > 0) && !(light->outer_cone > 0));
}

vec4s *punctual_light_table_make(const struct light *lights, uint32_t count)
{
    vec4s *rows = malloc((count + (size_t)1) * LIT_LIGHT_WIDTH * sizeof(*rows));
    for (uint32_t i = 0; rows && i < count; i++) {
        const struct light *m = &lights[i];
        vec4s *row = &rows[(size_t)i * LIT_LIGHT_WIDTH];
        const bool is_spot = m->kind == LIGHT_SPOT;
        /* Lights other than spots get cone cosines below -1, which light all directions. */
        const vec2s cone = { { is_spot ? cosf(m->inner_cone) : -2.0f,
                               is_spot ? cosf(m->outer_cone) : -3.0f } };
        row[LIT_LIGHT_POSITION] =
            glms_vec4(m->position, m->kind == LIGHT_DIRECTIONAL ? 0.0f : 1.0f);
        row[LIT_LIGHT_DIRECTION] =
            glms_vec4(m->direction, m->kind == LIGHT_DIRECTIONAL ? 0.0f : m->range);
        row[LIT_LIGHT_COLOR] = glms_vec4(glms_vec3_scale(m->color, m->intensity), 0.0f);
        row[LIT_LIGHT_CONE] = (vec4s){ { cone.x, cone.y, 0.0f, 0.0f } };
    }
    return rows;
}
