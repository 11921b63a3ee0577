/*
 * caustics_map.glsl: the region of the light map on the floor's plane, in pool coordinates.
 *
 * The map has all light that enters through the pool's surface, as if there were no walls: light on
 * a wall is looked up behind it, where it would reach the floor. A margin around that region is for
 * light that waves deflect.
 */
#ifndef LIB_CAUSTICS_MAP_GLSL
#define LIB_CAUSTICS_MAP_GLSL
#include "water.h"

const float caustics_map_margin = 0.15; /* share of the pool's depth */

/* Returns the region: in xy its corner with the lowest coordinates, in zw the lengths of its sides,
 * metres. `inside` is the direction of the sun's light below water at rest. */
vec4 caustics_map_region(pool_params pool, vec3 inside)
{
    vec2 shift = -inside.xy / inside.z * pool.depth;
    vec2 room = vec2(0.5 * pool.size + caustics_map_margin * pool.depth);
    vec2 lower = min(shift, vec2(0.0)) - room;
    vec2 upper = max(shift, vec2(0.0)) + room;
    return vec4(lower, upper - lower);
}

vec2 caustics_map_uv(pool_params pool, vec3 inside, vec2 on_floor)
{
    vec4 region = caustics_map_region(pool, inside);
    return (on_floor - region.xy) / region.zw;
}

#endif
