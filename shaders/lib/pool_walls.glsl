/* pool_walls.glsl: geometry and sunlight of the pool, a box of water. In pool coordinates, z is up
 * and calm water is at z = 0. Pool x is the world's x, and pool y is the world's -z. */
#ifndef POOL_WALLS_GLSL
#define POOL_WALLS_GLSL
#include "lib/globals.glsl"
#include "water/water.h"

vec3 pool_from_world(vec3 v)
{
    return vec3(v.x, -v.z, v.y);
}

vec3 pool_to_world(vec3 v)
{
    return vec3(v.x, v.z, -v.y);
}

/* Returns the unit direction to the sun, kept just above the horizon. */
vec3 pool_sun_dir()
{
    vec3 dir = pool_from_world(frame.sun_dir);
    return normalize(vec3(dir.xy, max(dir.z, 0.02)));
}

/* Returns the refracted direction of sunlight below calm water. */
vec3 pool_sun_inside(float ior)
{
    return refract(-pool_sun_dir(), vec3(0.0, 0.0, 1.0), 1.0 / ior);
}

/* Returns the distance along a ray from inside a box to its exit. Components of `dir` may be 0. */
float pool_exit(vec3 from, vec3 dir, vec3 lower, vec3 upper)
{
    vec3 far = mix(upper, lower, lessThan(dir, vec3(0.0)));
    vec3 t = mix((far - from) / dir, vec3(1e10), lessThan(abs(dir), vec3(1e-7)));
    return max(min(t.x, min(t.y, t.z)), 0.0);
}

/* Returns true if a point's xy is within the pool's walls. */
bool pool_is_open(vec2 p, float size)
{
    return max(abs(p.x), abs(p.y)) <= 0.5 * size;
}

/* Returns true if the pool's rim does not block the sun at a point of the water's surface. */
bool pool_is_lit(vec3 at, vec3 sun, float size)
{
    float rise = max(POOL_RIM - at.z, 0.0) / sun.z;
    return pool_is_open(at.xy, size) && pool_is_open(at.xy + rise * sun.xy, size);
}

/* Returns the fraction of calm water that is not in the rim's shadow. */
float pool_lit_fraction(vec3 sun, float size)
{
    vec2 lit = clamp(1.0 - abs(sun.xy) * POOL_RIM / (sun.z * size), 0.0, 1.0);
    return lit.x * lit.y;
}

#endif
