/*
 * mirror.glsl: ray march of the screen-space reflections: linear steps through the depth buffer of
 * the refractive objects, followed by bisection.
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

const int halvings = 4; /* bisections of the step in which the ray hits an object */

/* Segment of a reflected ray inside the objects' bounding box; its end points in clip space. */
struct part {
    float enters, leaves; /* the ray misses the box if leaves <= enters */
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

/* Returns the depth of a point behind the objects' front faces, metres along the view axis;
 * negative in front of the objects and beside them. */
float depth_behind_front(vec4 clip)
{
    vec2 uv = picture_uv(clip);
    float front = texelFetch(fronts, ivec2(uv * vec2(textureSize(fronts, 0))), 0).r;
    bool misses = front <= 0.0 || any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)));
    if (misses)
        return -1e30;
    return view_distance(frame.clip_from_world, clip.z / clip.w) -
           view_distance(frame.clip_from_world, front);
}

/* Returns the hit parameter along a segment, 0 to 1, or a value above 1 if nothing is hit. */
float find(part p)
{
    float t_before = 0.0, t_hit = 2.0;
    uint count = p.leaves > p.enters ? push.steps : 0u;
    for (uint i = 1u; i <= count && t_hit > 1.0; i++) {
        float t = (float(i) - 0.5) / float(count);
        float depth_behind = depth_behind_front(mix(p.from, p.to, t));
        if (depth_behind > 0.0 && depth_behind < push.thickness)
            t_hit = t;
        else
            t_before = t;
    }
    for (int i = 0; i < halvings && t_hit <= 1.0; i++) {
        float t = 0.5 * (t_before + t_hit);
        if (depth_behind_front(mix(p.from, p.to, t)) > 0.0)
            t_hit = t;
        else
            t_before = t;
    }
    return t_hit;
}

/* Returns true if a pixel shows a reflective surface that no object hides. */
bool is_mirror(ivec2 pixel)
{
    float depth = texelFetch(depths, pixel, 0).r;
    float front = texelFetch(fronts, pixel, 0).r;
    vec4 surface = texelFetch(surfaces, pixel, 0);
    return depth > front && surface.w > 0.0 && surface.z < MATERIAL_ROUGH;
}

/* Returns the surface point of a pixel, relative to the camera. */
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
