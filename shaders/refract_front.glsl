/*
 * refract_front.glsl: the ice's front faces as refract*.vert hands them on, and their normal: with
 * REFRACT_BUMP, that of the uneven surface.
 *
 * Choices come that way, too: how many colours bend each by itself (1 or 3), and of globals
 * refract_steps, refract_fresnel and bump_uv. A large shader that branches or loops as a uniform
 * says is compiled anew with each frame by lavapipe (Mesa 22.3), which keeps them all.
 */
#ifndef REFRACT_FRONT_GLSL
#define REFRACT_FRONT_GLSL
#include "lib/globals.glsl"
#include "refract.h"

layout(location = REFRACT_EYE_TO_POINT) in vec3 eye_to_point;
layout(location = REFRACT_NORMAL) in vec3 normal;
layout(location = REFRACT_FRESNEL) in float fresnel_paper; /* eq. 4, from the vertices */
layout(location = REFRACT_CHOICES) flat in uvec4 choices;

#ifdef REFRACT_BUMP
#include "bump.glsl"

layout(location = REFRACT_UV) in vec2 uv;

vec3 refract_front_normal()
{
    return bump_normal(normalize(eye_to_point), frame.eye + eye_to_point, normalize(normal), uv,
                       choices.w != 0u);
}
#else
vec3 refract_front_normal()
{
    return normalize(normal);
}
#endif

#endif
