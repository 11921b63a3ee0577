/* bubbles.frag: fragment shader of spherical bubbles in the ice. */
#version 460
#include "inclusions/bubbles.h"
#include "lib/bubble_deflection.glsl"
#include "lib/clip_to_ice_depth.glsl"
#include "lib/globals.glsl"
#include "lib/optics.glsl"
#include "lib/primary_ray.glsl"

#include "inclusions/bubbles_light.glsl"

layout(location = 0) in vec3 eye_to_square; /* camera to billboard point, world */
layout(location = 1) flat in vec3 eye_to_center;
layout(location = 2) flat in float radius;

layout(location = 0) out vec4 bubble; /* premultiplied alpha */

void main()
{
    vec3 e = primary_ray_dir(eye_to_square);
    float along = dot(eye_to_center, e);
    vec3 aside = along * e - eye_to_center; /* perpendicular from centre to ray */
    if (constant_orthographic != 0u)
        aside = eye_to_square - eye_to_center;
    float b = length(aside) / radius;
    if (b >= 1.0)
        discard;
    vec3 hit = (along - radius * sqrt(1.0 - b * b)) * e;
    if (constant_orthographic != 0u)
        hit = eye_to_center + aside - radius * sqrt(1.0 - b * b) * e;
    vec4 clip = frame.fitted_clip_from_world * vec4(frame.eye + hit, 1.0);
    if (!ice_clip_keeps(clip.z / clip.w))
        discard;

    float eta = frame.outside_in_air / frame.eta; /* relative index, ice to air */
    vec3 outward = aside / max(length(aside), 1e-30);
    float reflectance = optics_fresnel(e, (hit - eye_to_center) / radius, eta);
    vec3 reflected = bubble_rotate(e, outward, bubble_reflected(b));
    vec3 transmitted = bubble_rotate(e, outward, bubble_transmitted(b, eta));
    float cover = reflectance < 1.0 ? (1.0 - reflectance) * bubble_opacity(b, eta) : 0.0;
    bubble = vec4(bubble_light(reflected, reflectance, transmitted, cover), reflectance + cover);
}
