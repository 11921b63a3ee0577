/* refract_front_face_input.glsl: position and normal of the visible front face. Both are varyings
 * by default. With REFRACT_FULLSCREEN, both come from a G-buffer. With REFRACT_PHOTONS, main() sets
 * both. */
#ifndef REFRACT_FRONT_FACE_INPUT_GLSL
#define REFRACT_FRONT_FACE_INPUT_GLSL
#include "lib/primary_ray.glsl"
#include "refract/refract_uniforms.glsl"

#ifdef REFRACT_FULLSCREEN
#include "refract/refract_deferred_front_face.glsl"
#elif defined(REFRACT_PHOTONS)
vec3 eye_to_point;
vec3 normal; /* unit length; set by main() */

vec3 refract_front_normal()
{
    return normal;
}
#else
layout(location = REFRACT_EYE_TO_POINT) in vec3 eye_to_point;
layout(location = REFRACT_NORMAL) in vec3 normal;
layout(location = REFRACT_FRESNEL) in float fresnel_paper; /* eq. 4, per vertex */

#ifdef REFRACT_BUMP
#include "lighting/bump_fragment_normal.glsl"

vec3 refract_front_normal()
{
    return bump_normal(primary_ray_dir(eye_to_point), eye_to_point, normalize(normal));
}
#else
vec3 refract_front_normal()
{
    return normalize(normal);
}
#endif

void refract_front_read()
{
}
#endif

#endif
