/* environment_diffuse.glsl: diffuse environment light from binding LIT_ENVIRONMENT_BINDING. */
#ifndef ENVIRONMENT_DIFFUSE_GLSL
#define ENVIRONMENT_DIFFUSE_GLSL
#include "brdf.h"
#include "lib/procedural_sky.glsl"
#include "lib/specialization_constants.glsl"
#include "surroundings/surroundings.h"

layout(set = 0, binding = LIT_ENVIRONMENT_BINDING) uniform sampler2DArray environment_light;

/* Returns the environment's light on a white diffuse surface, without the built-in sky's sun. */
vec3 lit_diffuse(vec3 n)
{
    if (constant_background == GLOBALS_COLOR)
        return frame.background_color;
    if (constant_background == GLOBALS_ENVIRONMENT) {
        vec2 at = surroundings_equirect_uv(n, constant_environment_turn);
        return textureLod(environment_light, vec3(at, float(LIT_DIFFUSE_LAYER)), 0.0).rgb;
    }
    return sky_ambient(n);
}

#endif
