/* bump_mask.glsl: how smooth the ice is at a point, and how thick its crystals stand there. */
#ifndef BUMP_MASK_GLSL
#define BUMP_MASK_GLSL
#include "bump_plane.glsl"

layout(set = 0, binding = BUMP_MASK) uniform sampler2D bump_mask;

vec2 bump_mask_on(bump_planes planes)
{
    return texture(bump_mask, planes.uv[0]).rg * planes.shares.x +
           texture(bump_mask, planes.uv[1]).rg * planes.shares.y +
           texture(bump_mask, planes.uv[2]).rg * planes.shares.z;
}

vec2 bump_mask_by_uv(vec2 uv)
{
    return texture(bump_mask, uv * frame.bump_scale).rg;
}

vec2 bump_mask_at(vec3 point, vec3 normal, vec2 uv)
{
    if (frame.bump_uv != 0u)
        return bump_mask_by_uv(uv);
    return bump_mask_on(bump_find_planes(point, normal));
}

#endif
