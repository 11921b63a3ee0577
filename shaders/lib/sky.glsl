/* sky.glsl: sky.h by globals. */
#ifndef LIB_SKY_GLSL
#define LIB_SKY_GLSL
#include "lib/globals.glsl"
#include "sky.h"

vec3 sky_radiance(vec3 dir)
{
    return frame.sky_strength * sky_seen(dir, frame.sun_dir, frame.sun_strength);
}

vec3 sky_light(vec3 normal)
{
    return frame.sky_strength * sky_reflected(normal, frame.sun_dir, frame.sun_strength);
}

#endif
