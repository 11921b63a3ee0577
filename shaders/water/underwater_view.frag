/* underwater_view.frag: fragment shader of the view from below the water, or of the AOV `caustics`
 * with WATER_LAYER. Rays are intersected with the wave function itself. Within Snell's window the
 * scene above the surface is visible; outside it, and partly inside, the surface reflects the
 * ground. Radiance is not scaled by the squared index of refraction at the surface (water.c). */
#version 460
#include "lib/primary_ray.glsl"
#include "lib/specialization_constants.glsl"
#include "refract/refract.h"
#include "water/pool_radiance.glsl"

layout(location = REFRACT_VIEW_RAY) in vec3 ray;

#ifdef WATER_LAYER
layout(location = 0) out float out_caustics;
#else
layout(location = 0) out vec4 color;
#endif

const int below_steps = 96;
const int below_halvings = 12;

/* Returns the maximum height of the waves in the pool. */
float below_crest()
{
    water_params w = push.water;
    float across = 0.70711 * push.pool.size; /* half the pool's diagonal */
    return w.wave == WATER_SERIES ? 4.0 * w.height * w.amplitude * across : w.height * w.scale;
}

/* Returns the height of a point above the water surface. */
float below_height(vec3 at)
{
    return at.z - wave_at(push.water, at.xy, frame.time).z;
}

/* Returns the distance along a ray to the water surface, or `last` if there is no nearer hit. */
float below_surface(vec3 from, vec3 dir, float last)
{
    float crest = below_crest();
    float rise = abs(dir.z) > 1e-6 ? 1.0 / dir.z : 1e6;
    float first = dir.z > 0.0 ? max((-crest - from.z) * rise, 0.0) : 0.0;
    float t_max = dir.z > 0.0 ? (crest - from.z) * rise : (-crest - from.z) * rise;
    t_max = clamp(t_max, 0.0, last);
    float under = first, over = last;
    for (int i = 1; i <= below_steps; i++) {
        float t = mix(first, t_max, float(i) / float(below_steps));
        if (first >= t_max)
            break;
        if (below_height(from + t * dir) > 0.0) {
            over = t;
            break;
        }
        under = t;
    }
    for (int i = 0; i < below_halvings && over < last; i++) {
        float t = 0.5 * (under + over);
        if (below_height(from + t * dir) > 0.0)
            over = t;
        else
            under = t;
    }
    return over < last ? under : last;
}

/* A ray split by the water surface. `reflected` stays below the surface. `through` is the
 * transmitted radiance times the Fresnel transmittance. */
struct below_rays {
    water_ray reflected;
    vec3 through;
    float reflectance; /* weight of `reflected` */
};

below_rays below_split(vec3 from, vec3 e, float t)
{
    vec3 at = from + t * e;
    vec3 n = -wave_normal(wave_at(push.water, at.xy, frame.time));
    n = dot(n, e) > -1e-3 ? normalize(n - (dot(n, e) + 1e-3) * e) : n;
    vec3 out_dir = optics_refract(e, n, push.water.ior);
    vec3 in_dir = optics_reflect(e, n);
    float reflectance = optics_fresnel(e, n, push.water.ior);
    /* Keep both rays on their sides of the surface, so that neither hits a second wave. */
    out_dir = normalize(vec3(out_dir.xy, max(out_dir.z, 1e-3)));
    in_dir = normalize(vec3(in_dir.xy, min(in_dir.z, -1e-3)));
    vec3 throughput = transmittance(t);
    vec3 transmitted =
        reflectance < 1.0 ? (1.0 - reflectance) * radiance_above(at, out_dir) : vec3(0.0);
    return below_rays(water_ray(at, in_dir, false, throughput), throughput * transmitted,
                      reflectance);
}

void main()
{
    vec3 e = pool_from_world(primary_ray_dir(ray));
    vec3 from = pool_from_world(frame.eye + primary_ray_at(ray, 0.0));
    float last = path_to_ground(from, e);
    float t = below_surface(from, e, last);
    below_rays rays = below_rays(water_ray(from, e, false, vec3(1.0)), vec3(0.0), 1.0);
#ifdef WATER_WITH_ICE
    float to_ice = ice_distance(pool_to_world(from), pool_to_world(e));
    bool is_ice = to_ice >= 0.0 && to_ice < t;
    if (is_ice)
        rays.reflected = ice_below(rays.reflected);
#else
    const bool is_ice = false;
#endif
    if (t < last && !is_ice)
        rays = below_split(from, e, t);
    water_ground ground = water_radiance_along(rays.reflected);
#ifdef WATER_LAYER
    out_caustics = ground.caustics;
#else
    vec3 radiance = rays.through + rays.reflectance * ground.radiance;
    color = vec4(min(radiance, vec3(65504.0)), 1.0); /* largest half float */
#endif
}
