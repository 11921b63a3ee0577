/* refract.glsl: what the rungs' fragment shaders share: environment, results. */
#ifndef REFRACT_GLSL
#define REFRACT_GLSL
#include "lib/optics.glsl"
#include "refract_front.glsl"

layout(set = 0, binding = REFRACT_ENV_CUBE) uniform samplerCube env_cube;

struct refract_result {
    vec3 exit;       /* direction in which refracted light leaves: indexes the environment */
    vec3 refraction; /* radiance from there */
    vec3 reflection; /* radiance along the reflected direction */
    float fresnel;   /* share of the reflection */
};

/* Looks both directions up; the front normal alone reflects (eq. 3). */
refract_result refract_lookup(vec3 e, vec3 n_f, vec3 exit)
{
    refract_result r;
    r.exit = exit;
    r.refraction = texture(env_cube, exit).rgb;
    r.reflection = texture(env_cube, optics_reflect(e, n_f)).rgb;
    r.fresnel = clamp(fresnel_paper, 0.0, 1.0);
    return r;
}

#endif
