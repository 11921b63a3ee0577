/* pool_radiance.glsl: radiance along rays in the pool; WATER_WITH_... macros add caustics and ice.
 */
#ifndef POOL_RADIANCE_GLSL
#define POOL_RADIANCE_GLSL
#include "lib/environment_radiance.glsl"
#include "lib/optics.glsl"
#include "lib/pool_walls.glsl"
#include "water/pool_tiles.h"
#include "water/wave_function.h"

layout(push_constant, scalar) uniform Push
{
    water_push push;
};

layout(set = 0, binding = WATER_ENVIRONMENT) uniform sampler2D environment;

const vec3 up = vec3(0.0, 0.0, 1.0);

/* ---- floor and walls ---- */

vec3 tiles(vec2 at)
{
    vec2 x = at / push.pool.tile;
    return tiles_color(x, clamp(fwidth(x) * exp2(frame.lod_bias), 1e-4, 16.0));
}

/* ---- lighting ---- */

#ifdef WATER_WITH_CAUSTICS
#include "lib/caustics_map_coordinates.glsl"
layout(set = 0, binding = WATER_CAUSTICS) uniform sampler2D caustics;
#endif

/* Returns the sunlight on the ground relative to that below level, unbounded water. */
float water_sun_fraction(vec3 at, vec3 inside)
{
#ifdef WATER_WITH_CAUSTICS
    vec2 on_floor = at.xy - inside.xy / inside.z * (push.pool.depth + at.z);
    return texture(caustics, caustics_map_uv(push.pool, inside, on_floor)).r;
#else
    return pool_is_open(at.xy - inside.xy / inside.z * at.z, push.pool.size) ? 1.0 : 0.0;
#endif
}

vec3 transmittance(float path)
{
    return exp(-path * vec3(push.water.red, push.water.green, push.water.blue));
}

/* Returns the light that a white surface below the water reflects. The light is the sum of
 * sunlight, refracted as by level water, and sky light. Water absorbs part of both. */
vec3 light_below(vec3 at, vec3 n, float sun_fraction)
{
    vec3 sun_dir = pool_sun_dir();
    vec3 inside = pool_sun_inside(push.water.ior);
    float entering = 1.0 - optics_fresnel(-sun_dir, up, 1.0 / push.water.ior);
    float steepness = max(dot(n, inside) / inside.z, 0.0); /* 1 on level ground */
    vec3 sun = sky_sun() * entering * max(pool_from_world(frame.sun_dir).z, 0.0) * steepness *
               sun_fraction * transmittance(at.z / inside.z);
    vec3 sky = sky_ambient(pool_to_world(n)) * transmittance(-at.z);
    return sun + sky;
}

vec3 box_normal(vec3 at, vec3 upper)
{
    vec3 side = abs(at) / upper;
    if (max(side.x, side.y) < side.z)
        return up;
    return side.x > side.y ? vec3(-sign(at.x), 0.0, 0.0) : vec3(0.0, -sign(at.y), 0.0);
}

/* Returns the radiance of the dry walls or the sky along a ray that goes up. */
vec3 radiance_above(vec3 from, vec3 r)
{
    float half_size = 0.5 * push.pool.size;
    vec3 upper = vec3(half_size, half_size, 1e6);
    vec3 at = from + pool_exit(from, r, -upper, upper) * r;
    if (at.z >= POOL_RIM)
        return environment_radiance(environment, pool_to_world(r), 0.0);
    vec3 n = abs(at.x) > abs(at.y) ? vec3(-sign(at.x), 0.0, 0.0) : vec3(0.0, -sign(at.y), 0.0);
    return vec3(POOL_STONE) * sky_light(pool_to_world(n));
}

/* A ray in the pool, in pool coordinates. */
struct water_ray {
    vec3 from;
    vec3 dir;        /* unit; points up if `above` */
    bool above;      /* the ray has left the water */
    vec3 throughput; /* throughput of the path so far */
};

struct water_ground {
    vec3 radiance;
    float caustics; /* water_sun_fraction() at the hit */
};

/* Returns the distance along a ray to the floor or a wall. */
float path_to_ground(vec3 from, vec3 dir)
{
    float half_size = 0.5 * push.pool.size;
    return pool_exit(from, dir, vec3(vec2(-half_size), -push.pool.depth),
                     vec3(vec2(half_size), 1e6));
}

/* Returns the radiance along a ray, from the ground or, above water, from dry walls or the sky. */
water_ground water_radiance_along(water_ray ray)
{
    water_ground ground;
    float half_size = 0.5 * push.pool.size;
    vec3 upper = vec3(half_size, half_size, push.pool.depth);
    float path = path_to_ground(ray.from, ray.dir);
    vec3 at = ray.from + path * ray.dir;
    vec3 n = box_normal(at, upper);
    at.z = min(at.z, 0.0); /* walls above the rest level are lit as at the rest level */
    ground.caustics = water_sun_fraction(at, pool_sun_inside(push.water.ior));
    vec2 on_tiles = n.z > 0.5 ? at.xy : vec2(n.x != 0.0 ? at.y : at.x, at.z);
    vec3 light = light_below(at, n, ground.caustics);
    ground.radiance = ray.throughput * tiles(on_tiles) * light * transmittance(path);
    if (ray.above) {
        ground.radiance = ray.throughput * radiance_above(ray.from, ray.dir);
        ground.caustics = 0.0;
    }
    return ground;
}

#ifdef WATER_WITH_ICE
#include "water/march_floating_ice.glsl"
#endif

#endif
