/* lit_around.glsl: diffuse environment light (lit.h), from the texture at binding LIT_AROUND. */
#ifndef LIB_LIT_AROUND_GLSL
#define LIB_LIT_AROUND_GLSL
#include "background.h"
#include "lib/constants.glsl"
#include "lib/sky.glsl"
#include "lit.h"

layout(set = 0, binding = LIT_AROUND) uniform sampler2DArray environment_light;

/* Returns the environment's light on a white diffuse surface, without the built-in sky's sun. */
vec3 lit_matt(vec3 n)
{
    if (constant_background == GLOBALS_COLOR)
        return frame.background_color;
    if (constant_background == GLOBALS_ENVIRONMENT) {
        vec2 at = background_uv(n, constant_environment_turn);
        return textureLod(environment_light, vec3(at, float(LIT_MATT_LAYER)), 0.0).rgb;
    }
    return sky_ambient(n);
}

#endif
