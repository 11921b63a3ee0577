/*
 * photons.h: photon map of the sun's caustics, which objects cast onto the surroundings.
 *
 * Tracing from the camera cannot find caustics, because a ray from a diffuse surface practically
 * never hits the small sun through ice. So photons are emitted from the sun's disc, uniformly over
 * the objects' bounding sphere, sample reflection or refraction at each surface, and are stored on
 * the surroundings. Irradiance is their density within a radius (Jensen 1996, Global Illumination
 * using Photon Maps) that shrinks with the cube root of their number, so that noise and blur vanish
 * in the limit. Direct sunlight is not part of the map: it is sampled by shadow rays.
 *
 * Limits: surroundings cast no shadows in the map, as in the rasteriser; light that surroundings
 * reflect is lost; the density is too low within a radius of a surface's edge.
 */
#ifndef FIRN_LAB_REFERENCE_PHOTONS_H
#define FIRN_LAB_REFERENCE_PHOTONS_H

#include "src/base/parallel.h"
#include "src/base/status.h"
#include "src/lab/reference/tracer_context.h"

struct photon {
    vec3s position, dir;
    vec3s flux; /* unit: sunlight times square metres */
};

struct photons {
    struct photon *all; /* sorted by cell */
    uint32_t count;
    float radius;    /* radius of the density estimate, metres */
    uint32_t *first; /* first photon of each hash bucket */
    uint32_t bucket_count;
    float sun; /* tangent of the sun's angular radius */
    bool has_shadow;
};

struct photons_params {
    uint32_t count;                 /* number of photons to emit */
    float sun_deg;                  /* angular diameter of the sun, degrees */
    bool has_shadow;                /* objects cast shadows in direct sunlight */
    uint32_t threads;               /* upper limit of threads */
    parallel_progress_fn *progress; /* may be NULL; returning false cancels */
    void *user;
};

/* Builds the photon map. The result is equal for all numbers of threads. If out of memory, logs and
 * returns STATUS_TRY_AGAIN. If `progress` cancels, returns STATUS_FAILED without a log. */
MUST_USE enum status photons_init(struct photons *photons, const struct tracer *tracing,
                                  const struct photons_params *params);
void photons_finish(struct photons *photons); /* accepts {0} */

/* Returns direct and refracted sunlight at a point. The unit vector `normal` faces the viewer. */
struct radiance_sun photons_sun_at(const struct tracer *tracing, vec3s point, vec3s normal,
                                   uint32_t seed);

#endif
