/* ssr.glsl: ray march of the screen-space reflections. Takes linear steps through the depth buffer
 * of the refractive objects, then bisects. */
#ifndef SSR_GLSL
#define SSR_GLSL
#include "lib/object_pose.glsl"
#include "lib/octahedral_encoding.glsl"
#include "lib/primary_ray.glsl"
#include "material_layout.h"
#include "refract/refract.h"
#include "surroundings/ssr.h"

layout(set = 0, binding = SSR_DEPTH) uniform sampler2D depths;
layout(set = 0, binding = SSR_OBJECT_DEPTH) uniform sampler2D object_depths;
layout(set = 0, binding = SSR_SURFACE) uniform sampler2D surfaces;

layout(push_constant, scalar) uniform Push
{
    ssr_push push;
};

layout(location = REFRACT_VIEW_RAY) in vec3 ray;

const int halvings = 4; /* bisections of the step in which the ray hits an object */

/* Maximum depth behind a front face at which a ray still counts as a hit, relative to the
 * thickness. A ray that is deeper passes behind the object, where the depth buffer has no
 * information. */
const float crossing = 0.05;

/* Segment of a reflected ray inside the objects' bounding box; end points are in clip space. */
struct segment {
    float t_enter, t_leave; /* the ray misses the box if t_leave <= t_enter */
    vec4 from, to;
};

vec2 image_uv(vec4 clip)
{
    return clip.xy / clip.w * 0.5 + 0.5;
}

segment segment_in_box(vec3 point, vec3 dir)
{
    vec3 at = pose_to_object(point);
    vec3 along = transpose(mat3(frame.world_from_object)) * dir;
    vec3 inv = 1.0 / mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
    vec3 a = (push.box_min - at) * inv;
    vec3 b = (push.box_max - at) * inv;
    vec3 near = min(a, b), far = max(a, b);
    segment p;
    p.t_enter = max(max(near.x, near.y), max(near.z, 0.0));
    p.t_leave = min(far.x, min(far.y, far.z));
    p.from = frame.clip_from_world * vec4(point + p.t_enter * dir, 1.0);
    p.to = frame.clip_from_world * vec4(point + p.t_leave * dir, 1.0);
    return p;
}

/* Returns a point's depth behind the objects' front faces, in metres along the view axis. If the
 * point is in front of or beside the objects, the depth is negative. */
float depth_behind_front(vec4 clip)
{
    vec2 uv = image_uv(clip);
    float front = texelFetch(object_depths, ivec2(uv * vec2(textureSize(object_depths, 0))), 0).r;
    bool misses = front <= 0.0 || any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)));
    if (misses)
        return -1e30;
    return view_depth(frame.clip_from_world, clip.z / clip.w) -
           view_depth(frame.clip_from_world, front);
}

/* Returns the hit parameter along a segment, 0 to 1, or a value above 1 if nothing is hit. */
float intersect(segment p)
{
    float t_before = 0.0, t_hit = 2.0;
    uint count = p.t_leave > p.t_enter ? push.steps : 0u;
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
    bool is_crossed = depth_behind_front(mix(p.from, p.to, t_hit)) < crossing * push.thickness;
    return is_crossed ? t_hit : 2.0;
}

/* Returns true if a pixel shows a reflective surface that no object hides. */
bool is_reflective(ivec2 pixel)
{
    float depth = texelFetch(depths, pixel, 0).r;
    float front = texelFetch(object_depths, pixel, 0).r;
    vec4 surface = texelFetch(surfaces, pixel, 0);
    return depth > front && surface.w > 0.0 && surface.z < MATERIAL_ROUGH;
}

/* Returns the surface point of a pixel, relative to the camera. */
vec3 ssr_surface_point(ivec2 pixel, vec3 ray)
{
    float depth = texelFetch(depths, pixel, 0).r;
    return primary_ray_at(ray, view_depth(frame.clip_from_world, depth));
}

vec3 reflected_dir(ivec2 pixel, vec3 eye_to_point)
{
    vec4 surface = texelFetch(surfaces, pixel, 0);
    return reflect(primary_ray_dir(eye_to_point), octahedral_decode(surface.xy));
}

#endif
