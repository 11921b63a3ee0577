/*
 * refract_environment.glsl: looks up the environment from a point near the ice in a direction.
 *
 * The cube was drawn from the objects' centre. With REFRACT_LOOKUP_INFINITE only the direction is
 * used, as if everything were infinitely far away. With REFRACT_LOOKUP_DISTANCE a ray is marched
 * through the distances that the cube stores, to the first place behind what the cube shows (after
 * Szirmay-Kalos and others 2005, Approximate Ray-Tracing on the GPU with Distance Impostors). This
 * is wrong where a surface is hidden only from the centre. With REFRACT_LOOKUP_BOX a ray ends on
 * the box's sides
 * (lib/local_cube.glsl).
 */
#ifndef REFRACT_ENVIRONMENT_GLSL
#define REFRACT_ENVIRONMENT_GLSL
#include "lib/constants.glsl"
#include "lib/local_cube.glsl"
#include "refract_frame.glsl"

layout(set = 0, binding = REFRACT_ENV_CUBE) uniform samplerCube env_cube; /* a: 1 / metres */
#ifdef REFRACT_ENV_CUBE_POINTS
/* The same without a filter, where lavapipe reads a distance in half the time. */
layout(set = 0, binding = REFRACT_ENV_CUBE_POINTS) uniform samplerCube env_cube_points;
#else
#define env_cube_points env_cube
#endif

#ifdef REFRACT_NEAREST
layout(location = REFRACT_SEEN_MEAN, component = 3) flat in float cube_nearest; /* 1 / metres */
#else
const float cube_nearest = 0.0;
#endif

const int cube_divisions = 3; /* of the step that went behind a surface */

/* A ray that is farther behind a surface, in its own distance, after these divisions has passed
 * the surface's edge behind it. What it sees there is hidden from the centre. */
const float cube_passed = 0.15;

/* Returns how far a place, homogeneous and relative to the centre, is behind what the cube shows:
 * below 0, before it. Along a line this is linear where the surface is flat. The sky hides
 * nothing. */
float cube_behind(vec4 place)
{
    return length(place.xyz) * textureLod(env_cube_points, place.xyz, 0.0).a - place.w;
}

/* Two places of a ray, 0 to 1, between which it meets a surface. */
struct cube_ends {
    float before, behind;
    float at_before, at_behind; /* cube_behind() */
};

/* Returns the place between the ends at which linearly interpolated depth is 0. */
float cube_divide(cube_ends ends)
{
    float share = ends.at_before / min(ends.at_before - ends.at_behind, -1e-9);
    return mix(ends.before, ends.behind, share);
}

/* Returns the ends of the first step that goes behind a surface, or both at 1 if none does. */
cube_ends cube_find(vec4 from, vec4 to)
{
    cube_ends ends = cube_ends(0.0, 1.0, -1.0, 0.0);
    for (uint i = 1u; i <= constant_refract_steps; i++) {
        float u = float(i) / float(constant_refract_steps);
        float at = cube_behind(mix(from, to, u));
        if (at > 0.0) {
            ends.behind = u;
            ends.at_behind = at;
            break;
        }
        ends.before = u;
        ends.at_before = at;
    }
    return ends;
}

/* Returns the first place of a ray that is as far from the centre as the nearest surface. Steps
 * before it would find nothing, and be missed behind narrow surfaces. */
vec3 cube_begin(vec3 from_center, vec3 dir)
{
    if (cube_nearest <= 0.0)
        return from_center;
    float middle = dot(from_center, dir);
    float room = 1.0 / (cube_nearest * cube_nearest) - dot(from_center, from_center);
    return room > 0.0 ? from_center + (sqrt(middle * middle + room) - middle) * dir : from_center;
}

/*
 * Returns the direction in which a ray looks the cube up. A ray that passes behind a surface looks
 * beside its edge.
 *
 * Steps are even on the line from the ray's beginning to its end at infinity, as homogeneous
 * points, so that the directions that are tried are about evenly spaced, too.
 */
vec3 refract_cube_dir(vec3 point, vec3 dir)
{
    vec3 begin = cube_begin(point - frame.cube_center, dir);
    float scale = max(length(begin), 0.01 * refract_frame.radius);
    vec4 from = vec4(begin, 1.0);
    vec4 to = vec4(scale * dir, 0.0);
    cube_ends ends = cube_find(from, to);
    if (ends.at_behind <= 0.0) /* the sky */
        return to.xyz;
    for (int i = 0; i < cube_divisions; i++) {
        float u = i % 2 == 0 ? cube_divide(ends) : 0.5 * (ends.before + ends.behind);
        float at = cube_behind(mix(from, to, u));
        if (at > 0.0) {
            ends.behind = u;
            ends.at_behind = at;
        } else {
            ends.before = u;
            ends.at_before = at;
        }
    }
    bool is_past = ends.at_behind > cube_passed * (1.0 - ends.behind);
    return mix(from, to, is_past ? ends.before : cube_divide(ends)).xyz;
}

/* Returns whether a point is behind what the cube shows: where ice stands in wet ground, no air is
 * below its face, which mirrors nothing there. */
bool refract_is_in_ground(vec3 point)
{
    vec3 from_center = point - frame.cube_center;
    return constant_refract_lookup == REFRACT_LOOKUP_DISTANCE &&
           cube_behind(vec4(from_center, 1.0)) > 0.0;
}

vec3 refract_environment(vec3 point, vec3 dir)
{
    vec3 found = dir;
    if (constant_refract_lookup == REFRACT_LOOKUP_BOX)
        found = local_cube_dir(point, dir, frame.local_min, frame.local_max, frame.cube_center);
    else if (constant_refract_lookup == REFRACT_LOOKUP_DISTANCE)
        found = refract_cube_dir(point, normalize(dir));
    return textureLod(env_cube, found, 0.0).rgb;
}

#endif
