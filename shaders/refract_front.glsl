/*
 * refract_front.glsl: the inputs of front faces from refract*.vert, and their normal; with
 * REFRACT_BUMP, with bumps. With REFRACT_SEEN all of this is read from ice_normal.front; with
 * REFRACT_PHOTONS, main() finds it, if rays enter at all.
 */
#ifndef REFRACT_FRONT_GLSL
#define REFRACT_FRONT_GLSL
#include "lib/view_ray.glsl"
#include "refract_frame.glsl"

#ifdef REFRACT_SEEN
#include "refract_seen.glsl"
#elif defined(REFRACT_PHOTONS)
vec3 eye_to_point;
vec3 normal; /* unit */

vec3 refract_front_normal()
{
    return normal;
}
#else
layout(location = REFRACT_EYE_TO_POINT) in vec3 eye_to_point;
layout(location = REFRACT_NORMAL) in vec3 normal;
layout(location = REFRACT_FRESNEL) in float fresnel_paper; /* eq. 4, from the vertices */

#ifdef REFRACT_BUMP
#include "bump.glsl"

vec3 refract_front_normal()
{
    return bump_normal(view_dir(eye_to_point), eye_to_point, normalize(normal));
}
#else
vec3 refract_front_normal()
{
    return normalize(normal);
}
#endif

void refract_front_find()
{
}
#endif

#endif
