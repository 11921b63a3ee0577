/* environment_radiance.glsl: radiance of a uniform, mapped or procedural environment. */
#ifndef ENVIRONMENT_RADIANCE_GLSL
#define ENVIRONMENT_RADIANCE_GLSL
#include "lib/procedural_sky.glsl"
#include "lib/specialization_constants.glsl"
#include "surroundings/surroundings.h"

/* Returns the radiance of the sun's disc to add to an environment map; 0 outside the disc. */
vec3 environment_sun(sampler2D environment, vec3 dir, float lod)
{
    if (frame.sun_radius == 0.0)
        return vec3(0.0);
    float texel = 6.2831853 / float(textureSize(environment, 0).x);
    float blur = lod > 0.0 ? texel * exp2(lod) : 0.0;
    return min(frame.sun_light * sky_disc(dir, frame.sun_dir, frame.sun_radius, blur), 65000.0);
}

/* Returns the radiance along a unit direction; `lod` is the mip level of the environment map. */
vec3 environment_radiance(sampler2D environment, vec3 dir, float lod)
{
    if (constant_background == GLOBALS_COLOR)
        return frame.background_color;
    if (constant_background == GLOBALS_ENVIRONMENT)
        return textureLod(environment, surroundings_equirect_uv(dir, constant_environment_turn),
                          lod)
                   .rgb +
               environment_sun(environment, dir, lod);
    return sky_radiance(dir);
}

#endif
