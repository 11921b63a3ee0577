/*
 * photons.h: the sun's light that objects refract and reflect, on the surfaces around them.
 *
 * Photons leave the sun's disc evenly over the objects' bounding sphere, go through the objects as
 * light from the eye does, one way at each surface, and land on surfaces of the surroundings. The
 * light of a point is the density of the photons within a radius (Jensen 1996, Global Illumination
 * using Photon Maps), which shrinks with the third root of their number, so that noise and blur
 * both vanish. What the sun sends straight is no photon's: objects take it away from all points
 * that they hide from the sun's disc, and photons bring back what passes.
 *
 * Limits: surroundings cast no shadows, as in the rasteriser; light that they reflect is lost;
 * density is too small within the radius of a surface's edge.
 */
#ifndef FIRN_REFERENCE_PHOTONS_H
#define FIRN_REFERENCE_PHOTONS_H

#include "src/base/status.h"
#include "src/reference/tracing.h"

struct photon {
    vec3s position, dir;
    vec3s flux; /* square metres of the sun's light, each channel */
};

struct photons {
    struct photon *all; /* by cell */
    uint32_t count;
    float radius;    /* of the estimate, metres */
    uint32_t *first; /* photon of each bucket of cells, and at the end `count` */
    uint32_t bucket_count;
    float sun; /* tangent of the sun's angular radius */
    bool has_shadow;
};

/* Returns whether to go on. */
typedef bool photons_go_on_fn(void *user);

struct photons_params {
    uint32_t count;          /* of photons that leave the sun */
    float sun_deg;           /* diameter of the sun */
    bool has_shadow;         /* objects take away the sun's direct light */
    uint32_t threads;        /* at most */
    photons_go_on_fn *go_on; /* asked from time to time by the calling thread; may be NULL */
    void *user;
};

/* Traces photons; equal ones for any number of threads. Logs and returns STATUS_TRY_AGAIN, or,
 * when it was told to stop, returns STATUS_FAILED without a message. */
MUST_USE enum status photons_init(struct photons *photons, const struct tracing *tracing,
                                  const struct photons_params *params);
void photons_finish(struct photons *photons); /* {0} is fine */

/* Returns the sun's light at a point that is seen from the side of `normal`, unit. */
struct radiance_sun photons_sun_at(const struct tracing *tracing, vec3s point, vec3s normal,
                                   uint32_t seed);

#endif
