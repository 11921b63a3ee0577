/* procedural_sky.glsl: the sky functions of procedural_sky.h with the parameters of globals. */
#ifndef PROCEDURAL_SKY_GLSL
#define PROCEDURAL_SKY_GLSL
#include "lib/globals.glsl"
#include "surroundings/procedural_sky.h"

vec3 sky_radiance(vec3 dir)
{
    return frame.sky_strength * sky_radiance_with_sun(dir, frame.sun_dir, frame.sun_strength);
}

/* Returns the radiance of a white diffuse surface under the sky. */
vec3 sky_ambient(vec3 normal)
{
    return frame.sky_strength * sky_diffuse(normal);
}

/* Returns the radiance of a white diffuse surface that faces the sun, lit by the sun alone. */
vec3 sky_sun()
{
    return frame.sun_light;
}

vec3 sky_light(vec3 normal)
{
    return frame.sky_strength * sky_reflected(normal, frame.sun_dir, frame.sun_strength);
}

#endif
