/* sun_shadow_caustics.glsl: sunlight on surroundings, by the ice's shadow and caustic maps. */
#ifndef SUN_SHADOW_CAUSTICS_GLSL
#define SUN_SHADOW_CAUSTICS_GLSL
#include "lib/specialization_constants.glsl"
#include "lib/sun_light_space.glsl"

layout(set = 0, binding = ICE_CAUSTICS_MAP) uniform sampler2D sun_caustics_map;
layout(set = 0, binding = ICE_CAUSTICS_GROUND) uniform sampler2D sun_ground_depth;
layout(set = 0, binding = ICE_CAUSTICS_FRONT) uniform sampler2D sun_front_depth;

layout(set = 0, binding = ICE_CAUSTICS_SHADOW_MAP) uniform sampler2D sun_shadow_map;

struct sun_shadow {
    vec3 refracted;   /* sunlight refracted by the ice, relative to direct sunlight */
    float direct;     /* fraction of direct sunlight that the ice does not block */
    float visibility; /* fraction of sunlight that surroundings do not block */
};

/* Returns the sun's visibility at a light-space position. Shadows fade out at the map's edge. */
float sun_shadow_open(vec4 clip)
{
    vec2 uv = ice_light_uv(ice_light_shadow_map_clip(clip));
    vec2 inwards = min(uv, 1.0 - uv);
    float faded = 1.0 - smoothstep(0.0, 0.1, min(inwards.x, inwards.y));
    if (clip.w <= 0.0 || faded == 1.0)
        return 1.0;
    return mix(ice_light_pcf(sun_shadow_map, uv, clip.z / clip.w), 1.0, faded);
}

/* Returns the sunlight at a light-space position `clip`. `lifted` is the position shifted by the
 * shadow bias. If surroundings shade the position, there are no caustics. */
sun_shadow sun_shadow_lookup(vec4 clip, vec4 lifted)
{
    float visibility = sun_shadow_open(lifted);
    vec2 uv = ice_light_uv(clip);
    if (clip.w <= 0.0 || any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0))))
        return sun_shadow(vec3(0.0), 1.0, visibility);
    vec4 found = textureLod(sun_caustics_map, uv, 0.0);
    if (ice_light_is_hidden(sun_ground_depth, clip))
        found.rgb = vec3(0.0);
    bool covered = constant_ice_shadow != 0u && !ice_light_is_before(sun_front_depth, clip);
    return sun_shadow(found.rgb, covered ? 1.0 - found.a : 1.0, visibility);
}

/* Returns the sunlight at a surface point with vertex normal `n`. */
sun_shadow sun_shadow_at(vec3 point, vec3 n)
{
    return sun_shadow_lookup(ice_light_clip(point), ice_light_clip(ice_light_biased(point, n)));
}

#endif
