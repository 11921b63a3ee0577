/* refract_march_ray.glsl: marches a ray inside the ice through screen-space depth maps to its exit.
 * Without REFRACT_BOUNCE, only back faces are exits, and points in front of the ice are inside. */
#ifndef REFRACT_MARCH_RAY_GLSL
#define REFRACT_MARCH_RAY_GLSL
#include "refract/refract_depth_maps.glsl"
#include "refract/refract_exit_bracket.glsl"
#include "refract/refract_march.h"

#ifndef REFRACT_MARCH /* a struct refract_march */
layout(push_constant, scalar) uniform Push
{
    refract_march march;
};

#define REFRACT_MARCH march
#endif

#ifdef REFRACT_BOUNCE
layout(set = 0, binding = REFRACT_NORMAL_FRONT) uniform sampler2D normal_front;
#ifdef REFRACT_FULLSCREEN
layout(set = 0, binding = REFRACT_DEPTH_FRONT_MAP) uniform sampler2D depth_front_map;
#define MARCH_DEPTH_FRONT depth_front_map
#else
layout(set = 0, binding = REFRACT_DEPTH_FRONT) uniform sampler2D depth_front;
#define MARCH_DEPTH_FRONT depth_front
#endif
#endif

/* Constants of ray marching, copied once because lavapipe would load uniforms for each ray. */
struct march_space {
    mat4 map_from_world; /* clip coordinates scaled to texels */
    vec2 texel;
    vec3 center; /* of the object's bounding sphere */
    float radius;
    refract_march march;
};

march_space march_space_of_frame()
{
    mat4 m = refract_frame.clip_from_world;
    vec2 size = vec2(textureSize(depth_back, 0));
#ifdef MARCH_IMAGE_SIZE
    vec2 image_size = MARCH_IMAGE_SIZE;
#elif defined(REFRACT_FULLSCREEN)
    vec2 image_size = vec2(textureSize(shading, 0)); /* maps have a margin around it */
#else
    vec2 image_size = size;
#endif
    for (int i = 0; i < 4; i++)
        m[i].xy = 0.5 * image_size * m[i].xy + (0.5 * size - 0.5) * m[i].w;
    return march_space(m, 1.0 / size, refract_frame.center, refract_frame.radius, REFRACT_MARCH);
}

/* Distance in bounding radii where marching starts; coarse texels make nearer depths unreliable. */
const float march_start = 0.02;

/* Returns a point's signed distances to the back face (x) and to the front face (y), negative
 * outside. The unit is depth times w, in which distances to flat faces are linear along rays. */
vec2 march_signed_distances(march_space space, vec4 at)
{
    vec2 texels = at.xy / at.w;
    float back = refract_depth_at(depth_back, texels, space.texel);
    vec2 dists = vec2(fma(-back, at.w, at.z), -march_outside_silhouette);
#ifdef REFRACT_BOUNCE
    dists.y = fma(refract_depth_at(MARCH_DEPTH_FRONT, texels, space.texel), at.w, -at.z);
#endif
    return at.w > 0.0 && back > 0.0 ? dists : vec2(march_outside_silhouette);
}

bool march_is_near_front(vec2 dists)
{
    return dists.y < dists.x;
}

float march_signed_distance(vec2 dists)
{
    return march_is_near_front(dists) ? dists.y : dists.x;
}

bool march_is_inside(march_space space, vec4 at)
{
    return march_signed_distance(march_signed_distances(space, at)) >= 0.0;
}

/* Returns the distance along a ray to the object's bounding sphere. */
float march_exit_distance(march_space space, vec3 point, vec3 dir)
{
    vec3 from_center = point - space.center;
    float half_b = dot(from_center, dir);
    float outside = dot(from_center, from_center) - space.radius * space.radius;
    return sqrt(max(half_b * half_b - outside, 0.0)) - half_b;
}

/* Marches to the first step that leaves the object. A ray marked as hidden begins behind a face
 * that it has not crossed: its points count as inside until one is between the faces again or
 * outside the silhouette. Two independent steps are taken at a time, because the latency of the
 * address computation dominates, not the fetches. */
march_bracket march_step_outside(march_space space, vec4 from, vec4 map_dir, float first,
                                 float step_length, bool hidden)
{
    march_bracket ends;
    ends.within = first;
    ends.distance_within = 0.0;
    ends.near_front = false;
    for (uint i = 1u;; i += 2u) {
        float near = first + float(i) * step_length;
        float far = first + float(min(i + 1u, space.march.steps)) * step_length;
        vec2 dists_near = march_signed_distances(space, fma(vec4(near), map_dir, from));
        vec2 dists_far = march_signed_distances(space, fma(vec4(far), map_dir, from));
        float dist_near = march_signed_distance(dists_near);
        float dist_far = march_signed_distance(dists_far);
        bool near_hidden = hidden && dist_near < 0.0 && dist_near > march_outside_silhouette;
        bool near_outside = dist_near < 0.0 && !near_hidden;
        bool far_hidden = near_hidden && dist_far < 0.0 && dist_far > march_outside_silhouette;
        ends.beyond = near_outside ? near : far;
        ends.distance_beyond = near_outside ? dist_near : dist_far;
        if (!near_outside) {
            bool far_outside = dist_far < 0.0 && !far_hidden;
            ends.within = far_outside ? near : far;
            ends.distance_within = far_outside ? dist_near : dist_far;
            ends.near_front = march_is_near_front(far_outside ? dists_near : dists_far);
        }
        hidden = far_hidden;
        if ((ends.distance_beyond < 0.0 && !hidden) || i + 2u > space.march.steps)
            break;
    }
    return ends;
}

/*
 * Returns the distance along a ray to its exit, and whether front faces are nearer there. The last
 * step is refined to the precision of `halvings` bisections by the Illinois method: when the new
 * point is outside, the signed distance inside is halved, so that both ends converge; one iteration
 * is enough for a flat face. `jumps` is set if the depth is discontinuous there: no hit.
 *
 * Loops test their condition at the end, because a SIMD unit executes whole iterations until its
 * last ray has finished.
 */
float march_find_exit(march_space space, vec3 point, vec3 dir, bool hidden, out bool near_front,
                      out bool jumps)
{
    vec4 from = space.map_from_world * vec4(point, 1.0);
    vec4 map_dir = space.map_from_world * vec4(dir, 0.0);
    float first = march_start * space.radius;
    float step_length =
        (max(march_exit_distance(space, point, dir), first) - first) / float(space.march.steps);
    float exact = ldexp(step_length, -int(space.march.halvings));
    march_bracket ends = march_step_outside(space, from, map_dir, first, step_length, hidden);
    float difference = ends.distance_within - ends.distance_beyond;
    float t = march_root(ends, exact);
    bool done = t - ends.within < 0.5 * exact || space.march.halvings == 0u;
    for (uint i = 1u;; i++) {
        vec2 dists = march_signed_distances(space, fma(vec4(t), map_dir, from));
        float dist = march_signed_distance(dists);
        if (!done && dist < 0.0) {
            ends.beyond = t;
            ends.distance_beyond = dist;
            ends.distance_within *= 0.5;
        } else if (!done) {
            ends.within = t;
            ends.distance_within = dist;
            ends.near_front = march_is_near_front(dists);
        }
        t = march_root(ends, exact);
        done = done || t - ends.within < 0.5 * exact || i >= space.march.halvings;
        if (done)
            break;
    }
    near_front = ends.near_front;
    /* The signed distance changes only slowly behind the exit if the face is continuous. */
    float probe = march_signed_distance(
        march_signed_distances(space, fma(vec4(ends.within + 4.0 * exact), map_dir, from)));
    jumps = probe < -0.25 * difference && probe > march_outside_silhouette;
    return ends.within;
}

/* Returns the distance along a ray to the first point where it seems to leave the object. */
float march_length(march_space space, vec3 point, vec3 dir, out bool near_front)
{
    bool jumps;
    return march_find_exit(space, point, dir, false, near_front, jumps);
}

/* Returns the outward normal at a ray's exit. The exit is on the front face if `near_front`,
 * otherwise on the back face. If the ray cannot leave there, returns the opposite face's normal. */
vec3 march_normal(march_space space, vec3 point, vec3 dir, bool near_front)
{
    vec4 at = space.map_from_world * vec4(point, 1.0);
    vec2 uv = fma(at.xy / at.w, space.texel, 0.5 * space.texel);
    vec3 back = refract_normal_at(normal_back, uv);
#ifdef REFRACT_BOUNCE
    vec3 front = refract_normal_at(normal_front, uv);
    if (near_front)
        return dot(front, dir) > 0.0 ? front : back;
    return dot(back, dir) > 0.0 ? back : front;
#else
    return back;
#endif
}

#ifdef REFRACT_BOUNCE
/* Returns the outward normal at a ray's exit, of the front face if `near_front`, else the back. */
vec3 march_nearer_normal(march_space space, vec3 point, bool near_front)
{
    vec4 at = space.map_from_world * vec4(point, 1.0);
    vec2 uv = fma(at.xy / at.w, space.texel, 0.5 * space.texel);
    vec3 back = refract_normal_at(normal_back, uv);
    vec3 front = refract_normal_at(normal_front, uv);
    return near_front ? front : back;
}

#ifdef REFRACT_MATERIAL
/* Returns the transmittance at a ray's exit, of the front face if `near_front`, else the back. */
vec3 march_transmittance(march_space space, vec3 point, bool near_front)
{
    vec4 at = space.map_from_world * vec4(point, 1.0);
    vec2 uv = fma(at.xy / at.w, space.texel, 0.5 * space.texel);
    vec3 back = textureLod(material_back, uv, 0.0).rgb;
    vec3 front = textureLod(material_front, uv, 0.0).rgb;
    return near_front ? front : back;
}
#endif
#endif

#endif
