/*
 * bubbles_seen.glsl: the light that bubbles mirror and let through; with BUBBLES_FOLLOWED, it is
 * followed to where it leaves the ice, in the rung's maps. With BUBBLES_BENT, what over.frag needs
 * to show bubbles along bent rays.
 */
#ifndef BUBBLES_SEEN_GLSL
#define BUBBLES_SEEN_GLSL
#include "lib/ice_clip.glsl"

#ifdef BUBBLES_BENT
#include "within.glsl"

layout(set = 0, binding = BUBBLES_CRACKS) uniform sampler2D cracks_met;

layout(location = 1) out float seen_depth; /* of within.glsl */

/* Returns whether a crack that mirrors all hides a point on a ray from the eye, and writes the
 * point's depth. */
bool bubble_is_hidden(vec3 e, vec3 eye_to_point)
{
    vec4 met = texelFetch(cracks_met, ivec2(gl_FragCoord.xy), 0);
    seen_depth = within_depth(frame.eye + eye_to_point - frame.center, frame.forward, frame.radius);
    float n = frame.outside_in_air / frame.eta;
    float c = dot(met.yzw, e) / max(length(met.yzw), 1e-9);
    return met.r > 0.0 && met.r < seen_depth && n * n * (1.0 - c * c) > 1.0;
}
#else
bool bubble_is_hidden(vec3 e, vec3 eye_to_point)
{
    return false;
}
#endif

#ifdef BUBBLES_FOLLOWED
#define REFRACT_BOUNCE
#define REFRACT_PHOTONS
#define REFRACT_MARCH params.march
#define MARCH_GROUND
#define MARCH_PICTURE vec2(textureSize(ice_clip_front, 0))
#include "refract_bounce.h"

layout(push_constant, scalar) uniform Push
{
    refract_bounce_params params;
};

#include "refract_environment.glsl"
#include "refract_march.glsl"

bool march_is_in_ground(vec3 point)
{
    return refract_is_in_ground(point);
}

/* How exactly a bubble's light is followed, at most: it is small, and bends it much. */
const uint bubble_bounces = 2u;
const uint bubble_halvings = 4u;

march_space bubble_space()
{
    march_space space = march_space_of_frame();
    space.march.bounces = min(space.march.bounces, bubble_bounces);
    space.march.halvings = min(space.march.halvings, bubble_halvings);
    return space;
}

/* Returns the light that comes to a bubble from a direction. Where it enters the ice, it is as far
 * away as the cube's sky. */
vec3 bubble_light_from(vec3 eye_to_bubble, vec3 dir)
{
    refract_way way = refract_way(dir, frame.eye + eye_to_bubble, 0.0, 0.0, 0.0);
    float leaving;
#ifdef REFRACT_CLOUD
    march_scattered = vec3(0.0);
    march_straight = 1.0;
#endif
    march_on(bubble_space(), frame.eta, way, leaving);
    vec3 out_dir =
        march_is_in_ground(way.point) ? normalize(way.point - frame.cube_center) : way.dir;
    vec3 light = exp(-frame.absorb * way.path) * textureLod(env_cube, out_dir, 0.0).rgb;
#ifdef REFRACT_CLOUD
    light = march_straight * light + march_scattered;
#endif
    return light;
}

/* Follows the greater part of a bubble's light; the lesser one sees the cube at once. */
vec3 bubble_light(vec3 eye_to_bubble, vec3 mirrored, float share, vec3 passed, float cover)
{
    bool is_mirrored = share >= cover;
    vec3 lesser = textureLod(env_cube, is_mirrored ? passed : mirrored, 0.0).rgb;
    return max(share, cover) * bubble_light_from(eye_to_bubble, is_mirrored ? mirrored : passed) +
           min(share, cover) * lesser;
}

/* Returns what the eye sees of a bubble, premultiplied, through the ice before it. */
vec4 bubble_through(vec3 e, vec3 eye_to_bubble, vec4 bubble)
{
#ifdef REFRACT_CLOUD
    vec3 point = frame.eye + eye_to_bubble;
    float straight = 1.0;
    bool near_front;
    float t = march_length(bubble_space(), point, -e, near_front);
    vec3 scattered = refract_cloud(frame.cloud, point - t * e, e, t, straight);
    bubble.rgb = straight * bubble.rgb + bubble.a * scattered;
#endif
    return bubble;
}
#else
layout(set = 0, binding = BUBBLES_ENV_CUBE) uniform samplerCube env_cube;

/* Returns the light that a bubble mirrors and lets through, by the share and cover of each. */
vec3 bubble_light(vec3 eye_to_bubble, vec3 mirrored, float share, vec3 passed, float cover)
{
    return share * textureLod(env_cube, mirrored, 0.0).rgb +
           cover * textureLod(env_cube, passed, 0.0).rgb;
}

vec4 bubble_through(vec3 e, vec3 eye_to_bubble, vec4 bubble)
{
    return bubble;
}
#endif
#endif
