/*
 * refract_environment.glsl: environment lookup for rays that leave the ice.
 *
 * The cube map was rendered from the objects' centre. REFRACT_LOOKUP_INFINITE uses the direction
 * alone, as if everything were infinitely far away. REFRACT_LOOKUP_DISTANCE marches the ray through
 * the cube's distances to the first hit (after Szirmay-Kalos et al. 2005, Approximate Ray-Tracing
 * on the GPU with Distance Impostors); it fails for surfaces hidden from the centre.
 * REFRACT_LOOKUP_BOX projects onto a box (lib/box_projection.glsl).
 */
#ifndef REFRACT_ENVIRONMENT_GLSL
#define REFRACT_ENVIRONMENT_GLSL
#include "lib/box_projection.glsl"
#include "lib/specialization_constants.glsl"
#include "refract/refract_uniforms.glsl"

layout(set = 0, binding = REFRACT_ENV_CUBE) uniform samplerCube env_cube; /* a: 1 / metres */
#ifdef REFRACT_ENV_CUBE_POINTS
/* cube map with nearest filtering, which is twice as fast as linear filtering in lavapipe */
layout(set = 0, binding = REFRACT_ENV_CUBE_POINTS) uniform samplerCube env_cube_points;
#else
#define env_cube_points env_cube
#endif

#ifdef REFRACT_NEAREST
layout(location = REFRACT_FULLSCREEN_MEAN, component = 3) flat in float cube_nearest; /* 1/m */
#else
const float cube_nearest = 0.0;
#endif

const int cube_refinements = 3; /* root search iterations per hit */

/* Minimum depth behind a surface at which a ray passes behind the surface's edge, where the cube
 * map shows no hit. The depth is relative to the surface's distance. */
const float cube_occluded_min = 0.15;

/* Returns a point's signed depth behind the surface in the cube map, negative in front. If surfaces
 * are flat, the result is linear along a ray. `point` is relative to the cube's centre, in
 * homogeneous coordinates. */
float cube_depth_behind(vec4 point)
{
    return length(point.xyz) * textureLod(env_cube_points, point.xyz, 0.0).a - point.w;
}

/* Bracket of a ray's hit: a ray parameter before the surface and one behind it, from 0 to 1. */
struct cube_bracket {
    float before, behind;
    float at_before, at_behind; /* cube_depth_behind() at both ends */
};

/* Returns the estimated ray parameter of the hit, by linear interpolation between both ends. */
float cube_root(cube_bracket ends)
{
    float fraction = ends.at_before / min(ends.at_before - ends.at_behind, -1e-9);
    return mix(ends.before, ends.behind, fraction);
}

/* Returns a bracket around the first surface on a line. Both ends are 1 if there is no surface. */
cube_bracket cube_find_bracket(vec4 from, vec4 to)
{
    cube_bracket ends = cube_bracket(0.0, 1.0, -1.0, 0.0);
    for (uint i = 1u; i <= constant_refract_steps; i++) {
        float u = float(i) / float(constant_refract_steps);
        float at = cube_depth_behind(mix(from, to, u));
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

/* Returns the point where a search for a ray's hit may start. Around the cube's centre, a sphere up
 * to the nearest surface is empty. A ray inside the sphere starts where it leaves the sphere. */
vec3 cube_first_point(vec3 from_center, vec3 dir)
{
    if (cube_nearest <= 0.0)
        return from_center;
    float half_b = dot(from_center, dir);
    float minus_c = 1.0 / (cube_nearest * cube_nearest) - dot(from_center, from_center);
    return minus_c > 0.0 ? from_center + (sqrt(half_b * half_b + minus_c) - half_b) * dir
                         : from_center;
}

/*
 * Returns the direction from the cube's centre to a ray's hit. If the ray passes behind a surface's
 * edge, returns the direction beside the edge. The search spaces directions evenly, because its
 * steps are equal in homogeneous coordinates, from the ray's origin to infinity.
 */
vec3 refract_cube_dir(vec3 point, vec3 dir)
{
    vec3 begin = cube_first_point(point - frame.cube_center, dir);
    float scale = max(length(begin), 0.01 * refract_frame.radius);
    vec4 from = vec4(begin, 1.0);
    vec4 to = vec4(scale * dir, 0.0);
    cube_bracket ends = cube_find_bracket(from, to);
    if (ends.at_behind <= 0.0) /* no hit: the ray reaches the sky */
        return to.xyz;
    for (int i = 0; i < cube_refinements; i++) {
        float u = i % 2 == 0 ? cube_root(ends) : 0.5 * (ends.before + ends.behind);
        float at = cube_depth_behind(mix(from, to, u));
        if (at > 0.0) {
            ends.behind = u;
            ends.at_behind = at;
        } else {
            ends.before = u;
            ends.at_before = at;
        }
    }
    bool is_past = ends.at_behind > cube_occluded_min * (1.0 - ends.behind);
    return mix(from, to, is_past ? ends.before : cube_root(ends)).xyz;
}

/* Returns true if a point is in the ground, which is behind the surfaces of the cube map. Ice in
 * wet ground has no total internal reflection there, because no air is below. */
bool refract_is_below_ground(vec3 point)
{
    vec3 from_center = point - frame.cube_center;
    return constant_refract_lookup == REFRACT_LOOKUP_DISTANCE &&
           cube_depth_behind(vec4(from_center, 1.0)) > 0.0;
}

/* Returns the radiance that a ray reaches, and in a the reciprocal distance of the surface in the
 * cube map, 0 for the sky. */
vec4 refract_environment_texel(vec3 point, vec3 dir)
{
    vec3 found = dir;
    if (constant_refract_lookup == REFRACT_LOOKUP_BOX)
        found = box_projection_dir(point, dir, frame.local_min, frame.local_max, frame.cube_center);
    else if (constant_refract_lookup == REFRACT_LOOKUP_DISTANCE)
        found = refract_cube_dir(point, normalize(dir));
    return textureLod(env_cube, found, 0.0);
}

vec3 refract_environment(vec3 point, vec3 dir)
{
    return refract_environment_texel(point, dir).rgb;
}

/* Returns the radiance that a camera path reaches. If the image has no background, and a path that
 * has only been refracted reaches the sky, the result is 0 and `backdrop` 1, otherwise 0. */
vec3 refract_environment_seen(vec3 point, vec3 dir, bool is_refracted, out float backdrop)
{
    vec4 texel = refract_environment_texel(point, dir);
    bool is_backdrop = constant_backdrop == GLOBALS_BACKDROP_NONE && is_refracted && texel.a <= 0.0;
    backdrop = is_backdrop ? 1.0 : 0.0;
    return (1.0 - backdrop) * texel.rgb;
}

#endif
