/*
 * water_ice.glsl: light through ice that floats in the pool, followed in the ice's maps as
 * refract_bounce.c does, out into water below the surface at rest or into air above it.
 *
 * Of green light; colours do not part. Where surfaces mirror, what they mirror is left out but for
 * total reflection.
 */
#define REFRACT_BOUNCE
#define REFRACT_MARCH refract_march(16u, 8u, 4u)
#include "refract_inside.glsl"

const uint ice_steps = 24u; /* from the water's surface until a ray is in the ice */

/* Index of the ice over that of what is around it at a height. */
float ice_ratio(float height)
{
    return (height < 0.0 ? 1.0 / push.water.ior : 1.0) / frame.eta;
}

/* A ray that has left the ice, as look_along() wants it. One that goes up in water is mirrored by
 * the surface; one that goes down in air enters the water. Neither meets the ice again. */
water_ray ice_outside(water_ray ray)
{
    bool in_water = ray.from.z < 0.0;
    if (in_water) {
        ray.from.z = ray.dir.z > 0.0 ? -ray.from.z : ray.from.z;
        ray.dir.z = -abs(ray.dir.z);
    } else if (ray.dir.z < 0.0) {
        ray.kept *= 1.0 - optics_fresnel(ray.dir, up, 1.0 / push.water.ior);
        ray.from += ray.from.z / max(-ray.dir.z, 1e-3) * ray.dir;
        ray.dir = optics_refract(ray.dir, up, 1.0 / push.water.ior);
        in_water = true;
    }
    float half_size = 0.5 * push.pool.size;
    ray.from.xy = clamp(ray.from.xy, vec2(-half_size), vec2(half_size));
    ray.above = !in_water;
    return ray;
}

/* A ray that is in the ice, to where it leaves. */
water_ray ice_through(water_ray ray)
{
    vec3 point = pool_to_world(ray.from);
    vec3 dir = pool_to_world(ray.dir);
    march_space space = march_space_of_frame();
    for (uint i = 0u;; i++) {
        bool near_front;
        float t = march_length(space, point, dir, near_front);
        point += t * dir;
        ray.kept *= exp(-frame.absorb * t);
        vec3 n = march_normal(space, point, dir, near_front);
        if (dot(n, dir) <= 0.0)
            break;
        float ratio = ice_ratio(pool_from_world(point).z);
        bool total = optics_refract_k(dir, n, ratio) < 0.0;
        dir = optics_refract(dir, -n, ratio);
        if (!total || i == space.march.bounces)
            break;
    }
    ray.from = pool_from_world(point);
    ray.dir = pool_from_world(dir);
    return ice_outside(ray);
}

/* How far a ray in the water goes until it is in the ice; a negative number: it never is. */
float ice_distance(vec3 point, vec3 dir)
{
    march_space space = march_space_of_frame();
    vec4 from = space.map_from_world * vec4(point, 1.0);
    vec4 way = space.map_from_world * vec4(dir, 0.0);
    vec3 from_center = point - space.center;
    float middle = -dot(from_center, dir);
    float room = space.radius * space.radius - dot(from_center, from_center) + middle * middle;
    float last = middle + sqrt(max(room, 0.0));
    float first = max(middle - sqrt(max(room, 0.0)), 0.0);
    float outside = first;
    float inside = -1.0;
    for (uint i = 0u; i <= ice_steps && room > 0.0 && last > first; i++) {
        float t = mix(first, last, float(i) / float(ice_steps));
        if (march_is_inside(space, fma(vec4(t), way, from))) {
            inside = t;
            break;
        }
        outside = t;
    }
    for (uint i = 0u; i < REFRACT_MARCH.halvings && inside >= 0.0; i++) {
        float t = 0.5 * (outside + inside);
        if (march_is_inside(space, fma(vec4(t), way, from)))
            inside = t;
        else
            outside = t;
    }
    return inside;
}

/* A ray that has just entered the water: through the ice, if that is in its way. */
water_ray ice_below(water_ray ray)
{
    vec3 dir = pool_to_world(ray.dir);
    vec3 point = pool_to_world(ray.from);
    float t = ice_distance(point, dir);
    if (t < 0.0)
        return ray;
    point += t * dir;
    march_space space = march_space_of_frame();
    vec4 at = space.map_from_world * vec4(point, 1.0);
    bool near_front = march_is_near_front(march_rooms(space, at));
    vec3 n = -march_normal(space, point, -dir, near_front); /* it comes from there */
    ray.kept *= passed(t);
    ray.from = pool_from_world(point);
    if (dot(n, dir) > 0.0) {
        dir = optics_refract(dir, -n, push.water.ior * frame.eta);
        ray.dir = pool_from_world(dir);
        if (dot(n, dir) < 0.0) /* mirrored: the ice has the lower index */
            return ice_outside(ray);
    }
    return ice_through(ray);
}
