/*
 * surface.glsl: highlights of the lights on the ice's front.
 *
 * With SURFACE_VERTEX, the vertex shader's part, which passes values that are constant over a
 * triangle, because lavapipe's fragment shaders fetch uniforms float by float.
 */
#ifndef SURFACE_GLSL
#define SURFACE_GLSL
#include "lib/constants.glsl"
#include "lib/globals.glsl"
#include "refract.h"

#ifdef SURFACE_VERTEX
#define SURFACE_IO out
#else
#define SURFACE_IO in
#endif

/* xyz: from the eye to a light, world, metres; w: radiance of its highlight */
layout(location = REFRACT_LIGHTS) flat SURFACE_IO vec4 surface_lights[GLOBALS_LIGHT_COUNT];
layout(location = REFRACT_SHININESS) flat SURFACE_IO float surface_shininess;

#ifdef SURFACE_VERTEX
void surface_hand_on()
{
    for (int i = 0; i < GLOBALS_LIGHT_COUNT; i++)
        surface_lights[i] =
            vec4(frame.lights[i].xyz - frame.eye, frame.surface.strength * frame.lights[i].w);
    surface_shininess = frame.surface.shininess;
}
#else
/* Returns the radiance of the highlights towards the eye, which sees the point along e. */
float surface_highlight(vec3 e, vec3 eye_to_point, vec3 n_f)
{
    float highlight = 0.0;
    for (uint i = 0u; i < constant_lights; i++) {
        vec3 light_dir = normalize(surface_lights[i].xyz - eye_to_point);
        vec3 half_dir = normalize(light_dir - e);
        float c = dot(n_f, light_dir) > 0.0 ? max(dot(n_f, half_dir), 0.0) : 0.0;
        highlight += surface_lights[i].w * pow(c, surface_shininess);
    }
    return highlight;
}
#endif

#endif
