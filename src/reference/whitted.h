/*
 * whitted.h: recursive ray tracing through the object (Whitted).
 *
 * At a smooth surface light is reflected and refracted by Fresnel's equations and Snell's law. Both
 * branches are traced until their weight is below reference.cutoff or they have met
 * reference.bounces surfaces. No random numbers are used.
 *
 * Limits: the object must be closed, without inner walls, and the camera must be outside. With
 * interpolated normals a direction may be on the wrong side of a triangle: refracted light then
 * continues in that direction, as from the smooth surface; light that is reflected inside is
 * reflected by the triangle's own normal.
 */
#ifndef FIRN_REFERENCE_WHITTED_H
#define FIRN_REFERENCE_WHITTED_H

#include "src/reference/bvh.h"
#include "src/reference/reference_layers.h"
#include "src/tech/refract_reference.h"

enum {
    WHITTED_CHANNEL_COUNT = 3 /* red, green, blue */
};

struct whitted {
    const struct bvh *bvh;
    const struct radiance *radiance;
    float eta[WHITTED_CHANNEL_COUNT]; /* refractive index outside over inside */
    bool is_dispersive;               /* the channels' indices differ */
    vec3s absorb;                     /* 1 / metre */
    struct reference_params params;
};

/* Traces a ray, which must begin outside the object; `forward` is the view's axis, unit. */
struct reference_seen whitted_trace(const struct whitted *whitted, const struct bvh_ray *ray,
                                    vec3s forward);

#endif
