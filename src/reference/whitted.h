/*
 * whitted.h: what a ray sees, by following all the light that it divides into at the object.
 *
 * At a smooth surface light is reflected and refracted by Fresnel's and Snell's laws; both go on,
 * until what is left of one weighs less than reference.cutoff or has met reference.bounces
 * surfaces. Nothing is drawn by chance.
 *
 * Limits: the object must be closed, with no wall inside; the camera is taken to be outside.
 * Interpolated normals may send light to the wrong side of a triangle: what is refracted goes on
 * all the same, as from the smooth surface that is meant; what is reflected inside is reflected at
 * the triangle's own normal.
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
    bool is_dispersive;               /* they differ */
    vec3s absorb;                     /* 1 / metre */
    struct reference_params params;
};

/* `ray` begins outside the object; `forward` is the view's axis, unit. */
struct reference_seen whitted_trace(const struct whitted *whitted, const struct bvh_ray *ray,
                                    vec3s forward);

#endif
