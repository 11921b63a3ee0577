/* bump_fragment_normal.glsl: bump-mapped normal of the ice's surface at a fragment. */
#ifndef BUMP_FRAGMENT_NORMAL_GLSL
#define BUMP_FRAGMENT_NORMAL_GLSL
#include "lighting/bump_map_sampling.glsl"

layout(location = REFRACT_BUMP_SLOPE) flat in float bump_slope; /* factor on the map's slopes */

/* Returns the world-space height gradient from the three triplanar projections. */
vec3 bump_gradient_on(bump_planes planes)
{
    vec2 x = planes.texels[0].rg * planes.weights.x;
    vec2 y = planes.texels[1].rg * planes.weights.y;
    vec2 z = planes.texels[2].rg * planes.weights.z;
    return bump_world_from_object * vec3(y.y + z.x, z.y + x.x, x.y + y.x);
}

/* Returns the height gradient along the directions of the mesh's uv; 0 if the mesh has no uv. */
vec3 bump_gradient_uv(vec3 point, vec3 normal, vec2 slope)
{
    vec2 uv = bump_at.xy;
    vec3 across = cross(dFdy(point), normal);
    vec3 down = cross(normal, dFdx(point));
    vec3 u = across * dFdx(uv.x) + down * dFdy(uv.x);
    vec3 v = across * dFdx(uv.y) + down * dFdy(uv.y);
    float side = dot(dFdx(point), across) < 0.0 ? -1.0 : 1.0;
    return side * (slope.x * u * inversesqrt(max(dot(u, u), 1e-30)) +
                   slope.y * v * inversesqrt(max(dot(v, v), 1e-30)));
}

/* Returns the bump-mapped normal, adjusted to face the camera. */
vec3 bump_normal(vec3 e, vec3 point, vec3 normal)
{
    vec3 gradient;
    float smoothness;
    if (constant_bump_uv != 0u) {
        vec4 texel = bump_read_uv();
        gradient = bump_gradient_uv(point, normal, texel.rg);
        smoothness = texel.b;
    } else {
        bump_planes planes = bump_read_planes(normal);
        gradient = bump_gradient_on(planes);
        smoothness = bump_mask_on(planes).r;
    }
    gradient *= bump_slope * (1.0 - smoothness);
    return bump_facing(bump_perturbed(normal, gradient), normal, e);
}

#endif
