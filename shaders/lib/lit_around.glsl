/* lit_around.glsl: the light around surfaces that are no mirrors (lit.h), from a texture whose
 * binding is LIT_AROUND. */
#ifndef LIB_LIT_AROUND_GLSL
#define LIB_LIT_AROUND_GLSL
#include "background.h"
#include "lib/constants.glsl"
#include "lib/sky.glsl"
#include "lit.h"

layout(set = 0, binding = LIT_AROUND) uniform sampler2DArray environment_light;

/* Returns the light on a matt white surface, without the sun of the built-in sky. */
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
