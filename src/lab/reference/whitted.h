/*
 * whitted.h: recursive (Whitted-style) ray tracing through the scene's objects.
 *
 * A smooth surface splits light into reflection and refraction by the Fresnel equations and Snell's
 * law, with the indices of both media (nested_media.h); at a rough one each pixel sample hits one
 * microfacet (shaders/microfacet.h). Both branches are traced until their throughput is below
 * reference.cutoff or they have hit reference.bounces surfaces. Images of smooth objects are free
 * of noise, because no random numbers are used.
 *
 * Truncation loses energy. With reference.russian_roulette such rays continue as single paths that
 * sample reflection or refraction at each surface. Weak ones survive with a probability
 * proportional to their throughput and are reweighted, so that the estimate is unbiased and the
 * cost bounded.
 *
 * A crack in an object is a thin gap of outside air: it reflects 2 R / (1 + R) and does not deflect
 * transmitted light. A plane of air is composited by its opacity. Both exist only inside objects.
 * Bump maps perturb normals; frost covers a random fraction of a pixel's samples. A ray that
 * scatters in a medium (volume_scattering.h) becomes a single path as well, so that the ray tree
 * does not grow exponentially.
 *
 * Limits: interpolated normals may produce a direction on the wrong side of a triangle. Such a ray
 * ignores faces of the wrong orientation; internal reflection uses the geometric normal instead.
 */
#ifndef FIRN_LAB_REFERENCE_WHITTED_H
#define FIRN_LAB_REFERENCE_WHITTED_H

#include "src/lab/reference/reference_aov_table.h"
#include "src/lab/reference/tracer_context.h"

/* Finds the objects that contain a point, by counting the surfaces along a ray to infinity. */
void whitted_find_enclosing(const struct tracer *tracing, vec3s point,
                            struct nested_media_set *inside);

/* Traces a camera ray. `forward` is the unit view direction, `seed` the pixel's random seed. */
struct reference_ray_values whitted_trace(const struct tracer *tracing,
                                          const struct embree_scene_ray *ray, vec3s forward,
                                          uint32_t seed);

#endif
