/* ice_shine.glsl: sunlight on surroundings of the ice: shadow map and caustic map of
 * ice_caustics.c. */
#ifndef LIB_ICE_SHINE_GLSL
#define LIB_ICE_SHINE_GLSL
#include "lib/constants.glsl"
#include "lib/ice_light.glsl"

layout(set = 0, binding = ICE_CAUSTICS_MAP) uniform sampler2D shine_map;
layout(set = 0, binding = ICE_CAUSTICS_GROUND) uniform sampler2D shine_ground;
layout(set = 0, binding = ICE_CAUSTICS_FRONT) uniform sampler2D shine_front;

layout(set = 0, binding = ICE_CAUSTICS_SHADE) uniform sampler2D shine_shade;

struct ice_shine {
    vec3 through; /* light through the ice, relative to direct sunlight */
    float own;    /* fraction of direct sunlight that the ice does not block */
    float open;   /* fraction of sunlight that surroundings do not block */
};

/* Returns the shadow map's visibility of a biased point; shadows fade towards the map's edge. */
float ice_shine_open(vec4 clip)
{
    vec2 uv = ice_light_uv(ice_light_shade_clip(clip));
    vec2 inwards = min(uv, 1.0 - uv);
    float faded = 1.0 - smoothstep(0.0, 0.1, min(inwards.x, inwards.y));
    if (clip.w <= 0.0 || faded == 1.0)
        return 1.0;
    return mix(ice_light_open(shine_shade, uv, clip.z / clip.w), 1.0, faded);
}

/* Returns the sunlight at a light-space position. Points in shadow get no light through the ice;
 * `lifted` is the biased point for ice_shine_open(). */
ice_shine ice_shine_seen(vec4 clip, vec4 lifted)
{
    float open = ice_shine_open(lifted);
    vec2 uv = ice_light_uv(clip);
    if (clip.w <= 0.0 || any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0))))
        return ice_shine(vec3(0.0), 1.0, open);
    vec4 found = textureLod(shine_map, uv, 0.0);
    if (ice_light_is_hidden(shine_ground, clip))
        found.rgb = vec3(0.0);
    bool covered = constant_ice_shadow != 0u && !ice_light_is_before(shine_front, clip);
    return ice_shine(found.rgb, covered ? 1.0 - found.a : 1.0, open);
}

/* Returns the sunlight at a surface point with vertex normal `n`. */
ice_shine ice_shine_at(vec3 point, vec3 n)
{
    return ice_shine_seen(ice_light_clip(point), ice_light_clip(ice_light_lifted(point, n)));
}

#endif
