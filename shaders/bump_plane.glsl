/*
 * bump_plane.glsl: where the ice's maps lie on it: along three planes of the object's space that
 * fade into each other.
 */
#ifndef BUMP_PLANE_GLSL
#define BUMP_PLANE_GLSL
#include "bump.h"
#include "lib/globals.glsl"

struct bump_planes {
    vec2 uv[3];  /* on the planes across x, y and z: yz, zx, xy */
    vec3 shares; /* of the planes; their sum is 1 */
};

/* Of a point and its normal, both of the world. */
bump_planes bump_find_planes(vec3 point, vec3 normal)
{
    mat3 object_from_world = transpose(mat3(frame.world_from_object));
    vec3 p = object_from_world * (point - frame.center) * frame.bump_scale;
    vec3 n = object_from_world * normal;
    bump_planes planes;
    planes.uv[0] = p.yz;
    planes.uv[1] = p.zx + vec2(0.37, 0.61); /* else the three planes' middles look alike */
    planes.uv[2] = p.xy + vec2(0.71, 0.23);
    planes.shares = n * n * n * n;
    planes.shares /= planes.shares.x + planes.shares.y + planes.shares.z;
    return planes;
}

#endif
