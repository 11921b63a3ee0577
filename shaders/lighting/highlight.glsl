/* highlight.glsl: Blinn-Phong highlights of the light sources on the ice's front faces. With
 * HIGHLIGHT_VERTEX, it defines the vertex shader's functions. These pass uniforms as flat varyings,
 * because lavapipe's fragment shaders fetch each float of a uniform separately. */
#ifndef HIGHLIGHT_GLSL
#define HIGHLIGHT_GLSL
#include "lib/globals.glsl"
#include "lib/optics.glsl"
#include "lib/specialization_constants.glsl"
#include "refract/refract.h"

#ifdef HIGHLIGHT_VERTEX
#define HIGHLIGHT_IO out
#else
#define HIGHLIGHT_IO in
#endif

/* xyz: vector from the camera to a light, world, metres; w: its radiance */
layout(location = REFRACT_LIGHTS) flat HIGHLIGHT_IO vec4 highlight_lights[GLOBALS_LIGHT_COUNT];
/* x: Blinn-Phong exponent; y: relative index, outside to object, or 0 without Fresnel's factor */
layout(location = REFRACT_SHININESS) flat HIGHLIGHT_IO vec2 highlight_surface;

#ifdef HIGHLIGHT_VERTEX
void highlight_write_varyings()
{
    for (int i = 0; i < GLOBALS_LIGHT_COUNT; i++)
        highlight_lights[i] =
            vec4(frame.lights[i].xyz - frame.eye, frame.highlight.strength * frame.lights[i].w);
    highlight_surface = vec2(frame.highlight.shininess, float(frame.highlight.fresnel) * frame.eta);
}
#else
/* Returns the radiance of the highlights towards the camera; e is the view direction. */
float highlight_radiance(vec3 e, vec3 eye_to_point, vec3 n_f)
{
    float highlight = 0.0;
    for (uint i = 0u; i < constant_lights; i++) {
        vec3 light_dir = normalize(highlight_lights[i].xyz - eye_to_point);
        vec3 half_dir = normalize(light_dir - e);
        float c = dot(n_f, light_dir) > 0.0 ? max(dot(n_f, half_dir), 0.0) : 0.0;
        float reflectance =
            highlight_surface.y > 0.0 ? optics_fresnel(e, half_dir, highlight_surface.y) : 1.0;
        highlight += reflectance * (highlight_lights[i].w * pow(c, highlight_surface.x));
    }
    return highlight;
}
#endif

#endif
