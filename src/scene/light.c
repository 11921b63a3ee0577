/* light.c: what a light may be. */
#include "src/scene/light.h"
#include <math.h>
#include <string.h>

const char *light_kind_name(const struct light *light)
{
    static const char *const names[LIGHT_KIND_COUNT] = {
        [LIGHT_DIRECTIONAL] = "directional",
        [LIGHT_POINT] = "point",
        [LIGHT_SPOT] = "spot",
    };
    return names[light->kind];
}

/* Comparisons with NaN are false. */
static bool is_from(float value, float min, float max)
{
    return value >= min && value <= max;
}

bool light_is_sound(const struct light *light)
{
    const float far = 1e6f, half_pi = 1.5707964f;
    const bool is_spot = light->kind == LIGHT_SPOT;
    for (int k = 0; k < 3; k++) {
        if (!is_from(light->position.raw[k], -far, far) || !is_from(light->color.raw[k], 0, 65504))
            return false;
    }
    return light->kind < LIGHT_KIND_COUNT && memchr(light->name, 0, sizeof(light->name)) &&
           is_from(glms_vec3_norm(light->direction), 0.999f, 1.001f) &&
           is_from(light->intensity, 0, 1e30f) && is_from(light->range, 0, 1e30f) &&
           light->inner_cone >= 0 && is_from(light->outer_cone, 0, half_pi) &&
           (is_spot ? light->inner_cone < light->outer_cone
                    : !(light->inner_cone > 0) && !(light->outer_cone > 0));
}
