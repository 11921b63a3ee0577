/* surface.glsl: highlights of the lights on the ice's front. */
#ifndef SURFACE_GLSL
#define SURFACE_GLSL
#include "lib/constants.glsl"
#include "lib/globals.glsl"

/* Radiance towards the eye from a point of the world that is seen along e. */
float surface_highlight(vec3 e, vec3 point, vec3 n_f)
{
    float highlight = 0.0;
    for (uint i = 0u; i < constant_lights; i++) {
        vec3 light_dir = normalize(frame.lights[i].xyz - point);
        vec3 half_dir = normalize(light_dir - e);
        float c = dot(n_f, light_dir) > 0.0 ? max(dot(n_f, half_dir), 0.0) : 0.0;
        highlight += frame.lights[i].w * pow(c, frame.surface.shininess);
    }
    return frame.surface.strength * highlight;
}

#endif
