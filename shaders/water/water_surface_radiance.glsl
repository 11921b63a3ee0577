/* water_surface_radiance.glsl: radiance of the water surface for a camera above the water. */
#ifndef WATER_SURFACE_RADIANCE_GLSL
#define WATER_SURFACE_RADIANCE_GLSL
#include "water/pool_radiance.glsl"

layout(location = 0) in vec3 point; /* pool coordinates */

struct water_view {
    vec3 refraction; /* radiance of the ground along the refracted ray */
    vec3 reflection;
    float fresnel;  /* Fresnel reflectance */
    float caustics; /* water_sun_fraction() on the ground */
};

/* Returns the unit normal of the wave, bent towards the camera where it would face away. */
vec3 water_normal(vec3 e)
{
    vec3 n = wave_normal(wave_at(push.water, point.xy, frame.time));
    float away = dot(n, e) + 1e-3;
    return away > 0.0 ? normalize(n - away * e) : n;
}

water_view water_shade()
{
    water_view view;
    vec3 e = constant_orthographic != 0u ? pool_from_world(frame.forward)
                                         : normalize(point - pool_from_world(frame.eye));
    vec3 n = water_normal(e);
    vec3 r = optics_reflect(e, n);
    vec3 t = optics_refract(e, n, 1.0 / push.water.ior);
    /* Keep both rays on their sides of the surface, so that neither hits a second wave. */
    r = normalize(vec3(r.xy, max(r.z, 1e-3)));
    t = normalize(vec3(t.xy, min(t.z, -1e-3)));
    water_ray ray = water_ray(point, t, false, vec3(1.0));
#ifdef WATER_WITH_ICE
    ray = ice_below(ray);
#endif
    water_ground ground = water_radiance_along(ray);
    view.refraction = ground.radiance;
    view.caustics = ground.caustics;
    view.reflection = radiance_above(point, r);
    view.fresnel = optics_fresnel(e, n, 1.0 / push.water.ior);
    return view;
}

#endif
