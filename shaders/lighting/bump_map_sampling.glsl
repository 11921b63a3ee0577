/* bump_map_sampling.glsl: samples the ice's bump map by the mesh's uv or by triplanar mapping.
 * Triplanar mapping blends three projections along the axes of object space. */
#ifndef BUMP_MAP_SAMPLING_GLSL
#define BUMP_MAP_SAMPLING_GLSL
#include "lib/globals.glsl"
#include "lib/specialization_constants.glsl"
#include "lighting/bump.h"
#include "lighting/bump_normal.h"
#include "refract/refract.h"

/* Uniforms arrive as varyings, because lavapipe's fragment shaders read uniforms float by float. */
layout(location = REFRACT_BUMP_AT) in vec3 bump_at; /* texture coordinates: object space, or uv */
layout(location = REFRACT_BUMP_WORLD_FROM_OBJECT) flat in mat3 bump_world_from_object;

layout(set = 0, binding = BUMP_MAP) uniform sampler2D bump_map;

vec4 bump_read(vec2 at)
{
    return constant_tiled != 0u ? texture(bump_map, at, frame.lod_bias) : texture(bump_map, at);
}

struct bump_planes {
    vec4 texels[3]; /* samples of the bump map, projected along x, y and z */
    vec3 weights;   /* blend weights, whose sum is 1 */
};

/* Samples the bump map in three projections. `normal` is in world space. */
bump_planes bump_read_planes(vec3 normal)
{
    vec3 p = bump_at;
    vec3 n = transpose(bump_world_from_object) * normal;
    bump_planes planes;
    planes.texels[0] = bump_read(p.yz);
    planes.texels[1] = bump_read(p.zx + BUMP_OFFSET_Y);
    planes.texels[2] = bump_read(p.xy + BUMP_OFFSET_Z);
    planes.weights = bump_weights(n);
    return planes;
}

/* Samples the map at the mesh's uv. If the derivatives are 0, as without uv, reads mip level 0,
 * because lavapipe's anisotropic filter would return NaN (Mesa 25). */
vec4 bump_read_uv()
{
    vec2 at = bump_at.xy;
    bool is_point = fwidth(at) == vec2(0.0);
    return mix(bump_read(at), textureLod(bump_map, at, 0.0), bvec4(is_point));
}

/* Returns surface smoothness and frost thickness, blended over the three projections. */
vec2 bump_mask_on(bump_planes planes)
{
    return planes.texels[0].ba * planes.weights.x + planes.texels[1].ba * planes.weights.y +
           planes.texels[2].ba * planes.weights.z;
}

vec2 bump_mask_here(vec3 normal)
{
    if (constant_bump_uv != 0u)
        return bump_read_uv().ba;
    return bump_mask_on(bump_read_planes(normal));
}

#endif
