/*
 * mirror.glsl: follows rays that surfaces mirror through the depths of the objects' picture.
 */
#ifndef MIRROR_GLSL
#define MIRROR_GLSL
#include "lib/octahedron.glsl"
#include "lib/pose.glsl"
#include "lib/view_ray.glsl"
#include "material.h"
#include "mirror.h"

layout(set = 0, binding = MIRROR_DEPTH) uniform sampler2D depths;
layout(set = 0, binding = MIRROR_FRONT) uniform sampler2D fronts;
layout(set = 0, binding = MIRROR_SURFACE) uniform sampler2D surfaces;

layout(push_constant, scalar) uniform Push
{
    mirror_push push;
};

layout(location = 0) in vec3 ray;

const int halvings = 4; /* of the step in which a ray meets an object */

/* The part of a mirrored ray in the objects' box: metres from its begin, and homogeneous points of
 * the picture. */
struct part {
    float enters, leaves; /* leaves <= enters: it misses the box */
    vec4 from, to;
};

vec2 picture_uv(vec4 clip)
{
    return clip.xy / clip.w * 0.5 + 0.5;
}

part part_in_box(vec3 point, vec3 dir)
{
    vec3 at = pose_to_object(point);
    vec3 along = transpose(mat3(frame.world_from_object)) * dir;
    vec3 inv = 1.0 / mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
    vec3 a = (push.box_min - at) * inv;
    vec3 b = (push.box_max - at) * inv;
    vec3 near = min(a, b), far = max(a, b);
    part p;
    p.enters = max(max(near.x, near.y), max(near.z, 0.0));
    p.leaves = min(far.x, min(far.y, far.z));
    p.from = frame.clip_from_world * vec4(point + p.enters * dir, 1.0);
    p.to = frame.clip_from_world * vec4(point + p.leaves * dir, 1.0);
    return p;
}

/* Returns how far a point is behind the objects' fronts, metres along the view's axis; below 0
 * before them, and beside them. */
float behind(vec4 clip)
{
    vec2 uv = picture_uv(clip);
    float front = texelFetch(fronts, ivec2(uv * vec2(textureSize(fronts, 0))), 0).r;
    bool is_beside =
        front <= 0.0 || any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)));
    if (is_beside)
        return -1e30;
    return view_distance(frame.clip_from_world, clip.z / clip.w) -
           view_distance(frame.clip_from_world, front);
}

/* Returns the share of a part after which the ray meets an object; above 1: none. */
float find(part p)
{
    float before = 0.0, after = 2.0;
    uint count = p.leaves > p.enters ? push.steps : 0u;
    for (uint i = 1u; i <= count && after > 1.0; i++) {
        float share = (float(i) - 0.5) / float(count);
        float deep = behind(mix(p.from, p.to, share));
        if (deep > 0.0 && deep < push.thickness)
            after = share;
        else
            before = share;
    }
    for (int i = 0; i < halvings && after <= 1.0; i++) {
        float share = 0.5 * (before + after);
        if (behind(mix(p.from, p.to, share)) > 0.0)
            after = share;
        else
            before = share;
    }
    return after;
}

/* Returns whether a pixel shows a surface that mirrors the objects, no object before it. */
bool is_mirror(ivec2 pixel)
{
    float depth = texelFetch(depths, pixel, 0).r;
    float front = texelFetch(fronts, pixel, 0).r;
    vec4 surface = texelFetch(surfaces, pixel, 0);
    return depth > front && surface.w > 0.0 && surface.z < MATERIAL_ROUGH;
}

/* Returns the point that a pixel shows, from the eye. */
vec3 mirror_point(ivec2 pixel, vec3 ray)
{
    float depth = texelFetch(depths, pixel, 0).r;
    return view_at(ray, view_distance(frame.clip_from_world, depth));
}

vec3 mirrored_dir(ivec2 pixel, vec3 eye_to_point)
{
    vec4 surface = texelFetch(surfaces, pixel, 0);
    return reflect(view_dir(eye_to_point), octahedron_dir(surface.xy));
}

#endif
