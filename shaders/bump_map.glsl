/*
 * bump_map.glsl: what the ice's map says of a point of its surface.
 *
 * It lies on the ice along three planes of the object's space that fade into each other, or by the
 * mesh's uv.
 */
#ifndef BUMP_MAP_GLSL
#define BUMP_MAP_GLSL
#include "bump.h"
#include "lib/constants.glsl"
#include "lib/globals.glsl"
#include "refract.h"

/* From the vertex shader, since lavapipe's fragment shaders fetch uniforms float by float. */
layout(location = REFRACT_BUMP_AT) in vec3 bump_at; /* tiles of the map: object's space, or uv */
layout(location = REFRACT_BUMP_TURN) flat in mat3 bump_turn; /* from the object's space */

layout(set = 0, binding = BUMP_MAP) uniform sampler2D bump_map;

vec4 bump_read(vec2 at)
{
    return constant_tiled != 0u ? texture(bump_map, at, frame.lod_bias) : texture(bump_map, at);
}

struct bump_planes {
    vec4 texels[3]; /* of the planes across x, y and z: yz, zx, xy */
    vec3 shares;    /* of the planes; their sum is 1 */
};

/* Here, where the world's normal is this. */
bump_planes bump_read_planes(vec3 normal)
{
    vec3 p = bump_at;
    vec3 n = transpose(bump_turn) * normal;
    bump_planes planes;
    planes.texels[0] = bump_read(p.yz);
    planes.texels[1] = bump_read(p.zx + vec2(0.37, 0.61)); /* else the three planes' */
    planes.texels[2] = bump_read(p.xy + vec2(0.71, 0.23)); /* middles look alike */
    planes.shares = n * n * n * n;
    planes.shares /= planes.shares.x + planes.shares.y + planes.shares.z;
    return planes;
}

vec4 bump_read_uv()
{
    return bump_read(bump_at.xy);
}

/* How smooth the ice is, and how thick its crystals stand. */
vec2 bump_mask_on(bump_planes planes)
{
    return planes.texels[0].ba * planes.shares.x + planes.texels[1].ba * planes.shares.y +
           planes.texels[2].ba * planes.shares.z;
}

vec2 bump_mask_here(vec3 normal)
{
    if (constant_bump_uv != 0u)
        return bump_read_uv().ba;
    return bump_mask_on(bump_read_planes(normal));
}

#endif
