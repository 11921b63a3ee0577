/* bubbles_light.glsl: light that bubbles reflect and transmit, from the environment cube map.
 * BUBBLES_TRACED first marches rays from bubbles through the ice until they leave it.
 * BUBBLES_REFRACTED adds a depth output, in which composite.frag finds hits of refracted rays. */
#ifndef BUBBLES_LIGHT_GLSL
#define BUBBLES_LIGHT_GLSL
#include "lib/clip_to_ice_depth.glsl"

#ifdef BUBBLES_REFRACTED
#include "refract/inclusion_march.glsl"

layout(set = 0, binding = BUBBLES_CRACKS) uniform sampler2D cracks_hits;

layout(location = 1) out float out_depth; /* depth for the search in inclusion_march.glsl */

/* Returns true if a totally reflecting crack hides a point. Sets out_depth to the point's depth. */
bool bubble_is_hidden(vec3 e, vec3 eye_to_point)
{
    vec4 crack = texelFetch(cracks_hits, ivec2(gl_FragCoord.xy), 0);
    out_depth =
        inclusion_depth(frame.eye + eye_to_point - frame.center, frame.forward, frame.radius);
    float n = frame.outside_in_air / frame.eta;
    float c = dot(crack.yzw, e) / max(length(crack.yzw), 1e-9);
    return crack.r > 0.0 && crack.r < out_depth && n * n * (1.0 - c * c) > 1.0;
}
#else
bool bubble_is_hidden(vec3 e, vec3 eye_to_point)
{
    return false;
}
#endif

#ifdef BUBBLES_TRACED
#define REFRACT_BOUNCE
#define REFRACT_PHOTONS
#define REFRACT_MARCH params.march
#define MARCH_GROUND
#define MARCH_IMAGE_SIZE vec2(textureSize(ice_clip_front, 0))
#include "refract/refract_bounce.h"

layout(push_constant, scalar) uniform Push
{
    refract_bounce_params params;
};

#include "refract/refract_environment.glsl"
#include "refract/refract_march_path.glsl"

bool march_is_in_ground(vec3 point)
{
    return refract_is_below_ground(point);
}

/* Few bounces and bisections suffice, because errors hardly show in small images inside bubbles. */
const uint bubble_bounces = 2u;
const uint bubble_halvings = 4u;

march_space bubble_space()
{
    march_space space = march_space_of_frame();
    space.march.bounces = min(space.march.bounces, bubble_bounces);
    space.march.halvings = min(space.march.halvings, bubble_halvings);
    return space;
}

/* Returns the radiance that arrives at a bubble from direction `dir`. If the ray hits the ground,
 * looks up the environment cube map in the direction from its centre to the hit point. */
vec3 bubble_light_from(vec3 eye_to_bubble, vec3 dir)
{
    refract_path ray = refract_path(dir, frame.eye + eye_to_bubble, 0.0, 0.0, 0.0);
    float leaving;
#ifdef REFRACT_MEDIUM
    march_scattered = vec3(0.0);
    march_transmittance_media = 1.0;
#endif
    march_continue(bubble_space(), frame.eta, ray, leaving);
    vec3 out_dir =
        march_is_in_ground(ray.point) ? normalize(ray.point - frame.cube_center) : ray.dir;
    vec3 light = exp(-frame.absorb * ray.path) * textureLod(env_cube, out_dir, 0.0).rgb;
#ifdef REFRACT_MEDIUM
    light = march_transmittance_media * light + march_scattered;
#endif
    return light;
}

/* Returns a bubble's reflected and transmitted light. Traces the stronger of the two rays. For the
 * weaker ray, looks up env_cube. */
vec3 bubble_light(vec3 eye_to_bubble, vec3 reflected, float fresnel, vec3 transmitted, float cover)
{
    bool is_reflected = fresnel >= cover;
    vec3 weaker_light = textureLod(env_cube, is_reflected ? transmitted : reflected, 0.0).rgb;
    return max(fresnel, cover) *
               bubble_light_from(eye_to_bubble, is_reflected ? reflected : transmitted) +
           min(fresnel, cover) * weaker_light;
}

/* Applies the scattering medium between camera and bubble to the bubble's premultiplied colour:
 * attenuates the colour and adds in-scattered light. */
vec4 bubble_attenuate(vec3 e, vec3 eye_to_bubble, vec4 bubble)
{
#ifdef REFRACT_MEDIUM
    vec3 point = frame.eye + eye_to_bubble;
    float transmittance = 1.0;
    bool near_front;
    float t = march_length(bubble_space(), point, -e, near_front);
    vec3 scattered = refract_in_scatter(frame.medium, point - t * e, e, t, transmittance);
    bubble.rgb = transmittance * bubble.rgb + bubble.a * scattered;
#endif
    return bubble;
}
#else
layout(set = 0, binding = BUBBLES_ENV_CUBE) uniform samplerCube env_cube;

/* Returns the reflected and transmitted light of a bubble, weighted by reflectance and coverage. */
vec3 bubble_light(vec3 eye_to_bubble, vec3 reflected, float fresnel, vec3 transmitted, float cover)
{
    return fresnel * textureLod(env_cube, reflected, 0.0).rgb +
           cover * textureLod(env_cube, transmitted, 0.0).rgb;
}

vec4 bubble_attenuate(vec3 e, vec3 eye_to_bubble, vec4 bubble)
{
    return bubble;
}
#endif
#endif
