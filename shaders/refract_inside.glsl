/*
 * refract_inside.glsl: how far a ray goes inside the ice, as the maps show it, and where it leaves.
 *
 * With REFRACT_BOUNCE a ray can leave through front faces, too. Without, what lies before the front
 * faces counts as inside.
 */
#ifndef REFRACT_INSIDE_GLSL
#define REFRACT_INSIDE_GLSL
#include "refract_maps.glsl"
#include "refract_march.h"

#ifndef REFRACT_MARCH /* a struct refract_march */
layout(push_constant, scalar) uniform Push
{
    refract_march march;
};

#define REFRACT_MARCH march
#endif

#ifdef REFRACT_BOUNCE
layout(set = 0, binding = REFRACT_NORMAL_FRONT) uniform sampler2D normal_front;
layout(set = 0, binding = REFRACT_DEPTH_FRONT) uniform sampler2D depth_front;
#endif

/* A ray begins so many radii of the bounding sphere away from its surface: texels are coarse. */
const float march_start = 0.02;

/* Beside the silhouette is outside. */
bool march_is_inside(vec4 clip)
{
    float depth = clip.z / clip.w;
    float back = refract_depth_at(depth_back, clip);
    bool inside = clip.w > 0.0 && back > 0.0 && depth >= back;
#ifdef REFRACT_BOUNCE
    inside = inside && depth <= refract_depth_at(depth_front, clip);
#endif
    return inside;
}

/* How far a ray goes to the object's bounding sphere. */
float march_room(vec3 point, vec3 dir)
{
    vec3 from_center = point - frame.center;
    float middle = dot(from_center, dir);
    float outside = dot(from_center, from_center) - frame.radius * frame.radius;
    return sqrt(max(middle * middle - outside, 0.0)) - middle;
}

/* How far a ray goes inside. */
float march_length(vec3 point, vec3 dir)
{
    vec4 clip = refract_clip(point);
    vec4 way = frame.clip_from_world * vec4(dir, 0.0);
    float within = march_start * frame.radius;
    float room = max(march_room(point, dir), within);
    float beyond = room;
    for (uint i = 1u; i <= REFRACT_MARCH.steps; i++) {
        float t = mix(march_start * frame.radius, room, float(i) / float(REFRACT_MARCH.steps));
        if (!march_is_inside(clip + t * way)) {
            beyond = t;
            break;
        }
        within = t;
    }
    for (uint i = 0u; i < REFRACT_MARCH.halvings; i++) {
        float t = 0.5 * (within + beyond);
        if (march_is_inside(clip + t * way))
            within = t;
        else
            beyond = t;
    }
    return within;
}

/* The outward normal where a ray leaves: of the nearer face, if the ray can leave through it. */
vec3 march_normal(vec3 point, vec3 dir)
{
    vec4 clip = refract_clip(point);
    vec3 back = refract_normal_at(normal_back, clip);
#ifdef REFRACT_BOUNCE
    float depth = clip.z / clip.w;
    float to_back = depth - refract_depth_at(depth_back, clip);
    float to_front = refract_depth_at(depth_front, clip) - depth;
    vec3 front = refract_normal_at(normal_front, clip);
    if (to_front < to_back)
        return dot(front, dir) > 0.0 ? front : back;
    return dot(back, dir) > 0.0 ? back : front;
#else
    return back;
#endif
}

#endif
