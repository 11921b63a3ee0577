/* environment.glsl: radiance from infinitely far away. */
#ifndef LIB_ENVIRONMENT_GLSL
#define LIB_ENVIRONMENT_GLSL
#include "background.h"
#include "lib/constants.glsl"
#include "lib/sky.glsl"

/* Returns the radiance along a unit direction; `lod` is the mip level of the environment image. */
vec3 environment_radiance(sampler2D environment, vec3 dir, float lod)
{
    if (constant_background == GLOBALS_COLOR)
        return frame.background_color;
    if (constant_background == GLOBALS_ENVIRONMENT)
        return textureLod(environment, background_uv(dir, constant_environment_turn), lod).rgb;
    return sky_radiance(dir);
}

#endif
