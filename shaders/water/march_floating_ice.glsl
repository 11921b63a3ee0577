/* march_floating_ice.glsl: traces rays through floating ice by ray marching in depth and normal
 * maps (refract_bounce.c). Rays end in the air or below the level water surface. All colours take
 * the path of green light (no dispersion). Partial internal reflections are ignored. */
#define REFRACT_BOUNCE
#define REFRACT_MARCH refract_march(16u, 8u, 4u)
#include "refract/refract_march_ray.glsl"

const uint ice_steps = 24u; /* ray march steps between the water's surface and the ice */

/* Returns the index of refraction of the ice relative to that of water or air at a height. */
float ice_ratio(float height)
{
    return (height < 0.0 ? 1.0 / push.water.ior : 1.0) / frame.eta;
}

/* Continues a ray that has left the ice and does not enter it again. In water, a ray that goes up
 * is reflected at the surface. In air, a ray that goes down is refracted into the water. */
water_ray ice_outside(water_ray ray)
{
    bool in_water = ray.from.z < 0.0;
    if (in_water) {
        ray.from.z = ray.dir.z > 0.0 ? -ray.from.z : ray.from.z;
        ray.dir.z = -abs(ray.dir.z);
    } else if (ray.dir.z < 0.0) {
        ray.throughput *= 1.0 - optics_fresnel(ray.dir, up, 1.0 / push.water.ior);
        ray.from += ray.from.z / max(-ray.dir.z, 1e-3) * ray.dir;
        ray.dir = optics_refract(ray.dir, up, 1.0 / push.water.ior);
        in_water = true;
    }
    float half_size = 0.5 * push.pool.size;
    ray.from.xy = clamp(ray.from.xy, vec2(-half_size), vec2(half_size));
    ray.above = !in_water;
    if (in_water)
        ray.dir = normalize(vec3(ray.dir.xy, min(ray.dir.z, -1e-3)));
    return ray;
}

/* Traces a ray from inside the ice through total internal reflections to its exit. */
water_ray ice_through(water_ray ray)
{
    vec3 point = pool_to_world(ray.from);
    vec3 dir = pool_to_world(ray.dir);
    march_space space = march_space_of_frame();
    for (uint i = 0u;; i++) {
        bool near_front;
        float t = march_length(space, point, dir, near_front);
        point += t * dir;
        ray.throughput *= exp(-frame.absorb * t);
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

/* Returns the distance along a ray in the water to the ice; negative if the ray misses. */
float ice_distance(vec3 point, vec3 dir)
{
    march_space space = march_space_of_frame();
    vec4 from = space.map_from_world * vec4(point, 1.0);
    vec4 dir_map = space.map_from_world * vec4(dir, 0.0);
    vec3 from_center = point - space.center;
    float t_center = -dot(from_center, dir);
    float discriminant =
        space.radius * space.radius - dot(from_center, from_center) + t_center * t_center;
    float last = t_center + sqrt(max(discriminant, 0.0));
    float first = max(t_center - sqrt(max(discriminant, 0.0)), 0.0);
    float outside = first;
    float inside = -1.0;
    for (uint i = 0u; i <= ice_steps && discriminant > 0.0 && last > first; i++) {
        float t = mix(first, last, float(i) / float(ice_steps));
        if (march_is_inside(space, fma(vec4(t), dir_map, from))) {
            inside = t;
            break;
        }
        outside = t;
    }
    for (uint i = 0u; i < REFRACT_MARCH.halvings && inside >= 0.0; i++) {
        float t = 0.5 * (outside + inside);
        if (march_is_inside(space, fma(vec4(t), dir_map, from)))
            inside = t;
        else
            outside = t;
    }
    return inside;
}

/* Continues a ray that starts in the water, through the ice if the ray hits the ice. */
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
    bool near_front = march_is_near_front(march_signed_distances(space, at));
    vec3 n = -march_normal(space, point, -dir, near_front); /* exit of the reversed ray */
    ray.throughput *= transmittance(t);
    ray.from = pool_from_world(point);
    if (dot(n, dir) > 0.0) {
        dir = optics_refract(dir, -n, push.water.ior * frame.eta);
        ray.dir = pool_from_world(dir);
        if (dot(n, dir) < 0.0) /* total reflection, because ice has the lower index */
            return ice_outside(ray);
    }
    return ice_through(ray);
}
