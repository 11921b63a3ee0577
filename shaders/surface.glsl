/*
 * surface.glsl: Blinn-Phong highlights of the light sources on the ice's front faces.
 *
 * SURFACE_VERTEX selects the vertex shader's part, which passes per-draw constants as flat
 * varyings, because lavapipe's fragment shaders fetch each float of a uniform separately.
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

/* xyz: from the camera to a light, world, metres; w: radiance of its highlight */
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
/* Returns the radiance of the highlights towards the camera; e is the view direction. */
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
