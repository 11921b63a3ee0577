/*
 * refract_march.glsl: traces rays inside the ice in the maps until they leave; with REFRACT_BOUNCE
 * also after total reflections.
 */
#ifndef REFRACT_MARCH_GLSL
#define REFRACT_MARCH_GLSL
#include "refract_inside.glsl"
#include "refract_way.glsl"

#ifdef MARCH_GROUND
/* Returns whether a place is in the ground: no air is below a face that stands in it. */
bool march_is_in_ground(vec3 point);
#endif

#ifdef REFRACT_CLOUD
#include "refract_cloud.glsl"

vec3 march_scattered; /* light of clouds on the way that was traced last */
float march_straight; /* share of its light that no cloud has scattered; both are set by callers */
#endif

/* Traces a way inside on to where it leaves. `leaving` is the transmittance of its last surface: 0
 * if light does not leave. */
void march_on(march_space space, float eta, inout refract_way way, out float leaving)
{
    leaving = 0.0;
    for (uint i = 0u;; i++) {
        bool near_front;
        float t = march_length(space, way.point, way.dir, near_front);
#ifdef REFRACT_CLOUD
        march_scattered += exp(-refract_frame.absorb * way.path) *
                           refract_cloud(frame.cloud, way.point, way.dir, t, march_straight);
#endif
        way.point += t * way.dir;
        way.path += t;
        vec3 n = march_normal(space, way.point, way.dir, near_front);
        if (dot(n, way.dir) <= 0.0) /* no face was found: the ray goes straight on */
            break;
#ifdef MARCH_GROUND
        if (march_is_in_ground(way.point)) {
            leaving = 1.0;
            break;
        }
#endif
        bool total = optics_refract_k(way.dir, n, 1.0 / eta) < 0.0;
        leaving = 1.0 - optics_fresnel(way.dir, n, 1.0 / eta);
        way.dir = optics_refract(way.dir, -n, 1.0 / eta);
        way.tir = total && i == 0u ? 1.0 : way.tir;
        way.bounces += total ? 1.0 : 0.0;
        if (!total || i == space.march.bounces)
            break;
    }
}

/* Traces a ray that enters. */
refract_way march_follow(vec3 e, vec3 n_f, int channel, out float leaving)
{
    float eta = refract_frame.etas[channel];
    refract_way way = refract_leave_at_front(optics_refract(e, n_f, eta));
    march_on(march_space_of_frame(), eta, way, leaving);
    return way;
}

refract_way refract_follow(vec3 e, vec3 n_f, int channel)
{
    float leaving;
    return march_follow(e, n_f, channel, leaving);
}

#endif
