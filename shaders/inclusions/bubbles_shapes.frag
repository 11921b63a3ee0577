/* bubbles_shapes.frag: fragment shader of ellipsoidal and capsule-shaped bubbles in the ice. */
#version 460
#include "inclusions/bubbles.h"
#include "lib/bubble_deflection.glsl"
#include "lib/bubble_intersect.glsl"
#include "lib/clip_to_ice_depth.glsl"
#include "lib/globals.glsl"
#include "lib/optics.glsl"
#include "lib/primary_ray.glsl"

#include "inclusions/bubbles_light.glsl"

layout(location = 0) in vec3 eye_to_rectangle; /* camera to billboard point, world */
layout(location = 1) flat in vec3 eye_to_center;
layout(location = 2) flat in float radius;
layout(location = 3) flat in vec4 axis; /* xyz: unit; w: stretch */
layout(location = 4) flat in float is_capsule;

layout(location = 0) out vec4 bubble; /* premultiplied alpha */

vec2 intersect_bubble(vec3 from, vec3 dir)
{
    return bubble_intersect(from, dir, axis.xyz, axis.w, radius, is_capsule > 0.5);
}

vec3 normal_at(vec3 from)
{
    return bubble_normal(from, axis.xyz, axis.w, radius, is_capsule > 0.5);
}

/* Shades like bubbles.frag, but traces transmitted rays through ellipsoids and capsules. */
void main()
{
    vec3 e = primary_ray_dir(eye_to_rectangle);
    vec3 from = eye_to_rectangle - eye_to_center; /* ray point relative to the centre */
    vec2 at = intersect_bubble(from, e);
    if (at.x > at.y)
        discard;
    vec3 hit = from + at.x * e;
    vec4 clip = frame.fitted_clip_from_world * vec4(frame.eye + eye_to_center + hit, 1.0);
    if (!ice_clip_keeps(clip.z / clip.w))
        discard;

    float eta = frame.outside_in_air / frame.eta; /* relative index, ice to air */
    vec3 n = normal_at(hit);
    n = dot(n, e) < 0.0 ? n : -e;
    float reflectance = optics_fresnel(e, n, eta);
    vec3 inside = refract(e, n, eta); /* 0 for total internal reflection */
    vec3 last = hit + max(intersect_bubble(hit, inside).y, 0.0) * inside;
    vec3 transmitted = reflectance < 1.0 ? refract(inside, -normal_at(last), 1.0 / eta) : e;
    float b2 = 1.0 - dot(n, e) * dot(n, e);
    float cover = reflectance < 1.0 ? (1.0 - reflectance) * bubble_opacity(sqrt(b2), eta) : 0.0;
    vec3 light = bubble_light(optics_reflect(e, n), reflectance, transmitted, cover);
    bubble = vec4(light, reflectance + cover);
}
