/* sky.glsl: sky.h by globals. */
#ifndef LIB_SKY_GLSL
#define LIB_SKY_GLSL
#include "lib/globals.glsl"
#include "sky.h"

vec3 sky_radiance(vec3 dir)
{
    return frame.sky_strength * sky_seen(dir, frame.sun_dir, frame.sun_strength);
}

/* Light of the sky on a matt white surface. */
vec3 sky_ambient(vec3 normal)
{
    return frame.sky_strength * sky_diffuse(normal);
}

/* That of the sun on one that is square to it. */
vec3 sky_sun()
{
    return frame.sky_strength * frame.sun_strength * SKY_SUN_COLOR;
}

vec3 sky_light(vec3 normal)
{
    return frame.sky_strength * sky_reflected(normal, frame.sun_dir, frame.sun_strength);
}

#endif
