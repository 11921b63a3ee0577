/*
 * caustics_map_coordinates.glsl: coordinates of the pool's caustic map, on the plane of the floor.
 *
 * Points on walls are mapped to the floor plane along the direction of sunlight in calm water. The
 * map has a margin, because waves deflect light.
 */
#ifndef CAUSTICS_MAP_COORDINATES_GLSL
#define CAUSTICS_MAP_COORDINATES_GLSL
#include "water/water.h"

const float caustics_map_margin = 0.15; /* fraction of the pool's depth */

/* Returns the map's rectangle in pool coordinates, metres. xy is the lower corner, zw the side
 * lengths. `inside` is the refracted direction of sunlight below calm water. */
vec4 caustics_map_region(pool_params pool, vec3 inside)
{
    vec2 shift = -inside.xy / inside.z * pool.depth;
    vec2 margin = vec2(0.5 * pool.size + caustics_map_margin * pool.depth);
    vec2 lower = min(shift, vec2(0.0)) - margin;
    vec2 upper = max(shift, vec2(0.0)) + margin;
    return vec4(lower, upper - lower);
}

/* Returns the height above the floor, in metres, at which the sunlight of map point `at` hits a
 * wall. If the sunlight reaches the floor, returns 0. Sets `facing` to the wall's normal. */
float caustics_map_height(pool_params pool, vec3 inside, vec2 at, out vec2 facing)
{
    vec2 slope = inside.xy / -inside.z;
    vec2 behind = (abs(at) - 0.5 * pool.size) / max(abs(slope), 1e-6);
    behind = mix(vec2(0.0), behind, greaterThan(at * slope, vec2(0.0)));
    facing = -sign(slope) * (behind.x > behind.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
    return clamp(max(behind.x, behind.y), 0.0, pool.depth);
}

vec2 caustics_map_uv(pool_params pool, vec3 inside, vec2 on_floor)
{
    vec4 region = caustics_map_region(pool, inside);
    return (on_floor - region.xy) / region.zw;
}

#endif
