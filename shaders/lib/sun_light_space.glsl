/* sun_light_space.glsl: light space of the sun, for shadow and caustic maps (uniform `light`).
 * Depth is the near plane's distance over the point's distance, or 0 without a surface. */
#ifndef SUN_LIGHT_SPACE_GLSL
#define SUN_LIGHT_SPACE_GLSL
#include "lib/globals.glsl"
#include "lighting/ice_caustics.h"

layout(set = 0, binding = ICE_CAUSTICS_LIGHT, scalar) uniform Light
{
    ice_caustics_light light;
};

vec4 ice_light_clip(vec3 point)
{
    return light.clip_from_world * vec4(point, 1.0);
}

vec2 ice_light_uv(vec4 clip)
{
    return clip.xy / clip.w * 0.5 + 0.5;
}

/* Returns a point shifted towards the sun by the shadow bias, which avoids self-shadowing. The
 * shift is along normal `n`, which may point to either side of the surface. */
vec3 ice_light_biased(vec3 point, vec3 n)
{
    return point + (dot(n, frame.sun_dir) < 0.0 ? -light.shadow_bias : light.shadow_bias) * n;
}

/* Converts a position from the caustic map's clip space to the shadow map's clip space. */
vec4 ice_light_shadow_map_clip(vec4 clip)
{
    return vec4(clip.xy * (light.reach / ICE_CAUSTICS_SHADOW_MAP_REACH), clip.zw);
}

/* Samples a light-space image of the ice at a caustic map uv; returns 0 outside the image. */
vec4 ice_light_sample(sampler2D image, vec2 uv)
{
    vec2 at = (uv - 0.5) * light.reach + 0.5;
    bool is_outside = any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)));
    return is_outside ? vec4(0.0) : textureLod(image, at, 0.0);
}

/* Returns true if a light-space position is in front of the ice's front faces. */
bool ice_light_is_before(sampler2D front, vec4 clip)
{
    float depth = ice_light_sample(front, ice_light_uv(clip)).r;
    return depth > 0.0 && clip.z / clip.w > depth;
}

/* Returns true if the ground hides a point from the sun. The point's depth is compared, with a
 * tolerance, with the farthest of four texels in the ground's light-space depth map. */
bool ice_light_is_hidden(sampler2D ground, vec4 clip)
{
    const float tolerance = 0.02 / ICE_CAUSTICS_DISTANCE;
    vec4 d = textureGather(ground, ice_light_uv(clip));
    float farthest = min(min(d.x, d.y), min(d.z, d.w));
    return clip.z / clip.w < farthest * (1.0 - tolerance);
}

/* Returns the lit fraction by percentage-closer filtering of four texels, bilinearly weighted. */
float ice_light_pcf(sampler2D shadow_map, vec2 uv, float depth)
{
    vec2 at = uv * float(ICE_CAUSTICS_SHADOW_MAP_SIZE) - 0.5;
    vec2 fraction = at - floor(at);
    uv = (floor(at) + 1.0) / float(ICE_CAUSTICS_SHADOW_MAP_SIZE);
    vec4 lit = vec4(lessThanEqual(textureGather(shadow_map, uv), vec4(depth)));
    vec2 across = mix(lit.wx, lit.zy, fraction.x); /* interpolated along u, both rows */
    return mix(across.x, across.y, fraction.y);
}

#endif
