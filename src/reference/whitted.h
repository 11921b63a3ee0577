/*
 * whitted.h: recursive (Whitted-style) ray tracing through the scene's objects.
 *
 * At a smooth surface light splits into reflection and refraction by the Fresnel equations and
 * Snell's law, with the indices of the media on both sides (nested_media.h). At a rough surface
 * each pixel sample hits one microfacet (microfacet.h). Both branches are traced until their
 * throughput is below reference.cutoff or they have hit reference.bounces surfaces. Splitting
 * instead of sampling makes images of smooth objects free of noise, since they use no random
 * numbers.
 *
 * Truncation loses energy. With reference.russian_roulette such rays continue as single paths that
 * sample reflection or refraction at each surface, and weak ones undergo Russian roulette: they
 * survive with a probability proportional to their throughput and are reweighted, so that the
 * estimate is unbiased and the cost bounded.
 *
 * A crack in an object is a thin gap of outside air: it reflects 2 R / (1 + R) and does not deflect
 * transmitted light. A plane of air is composited by its opacity. Both exist only inside objects.
 *
 * Bump maps perturb the normals of objects; frost covers a random fraction of a pixel's samples.
 *
 * Where air is a scattering medium (volume_scattering.h), a scattered ray becomes a single path as
 * well, so that the ray tree does not grow exponentially.
 *
 * Limits: interpolated normals may produce a direction on the wrong side of a triangle. Such a ray
 * continues as from the smooth surface and ignores faces of the wrong orientation; only internal
 * reflection uses the geometric normal instead.
 */
#ifndef FIRN_REFERENCE_WHITTED_H
#define FIRN_REFERENCE_WHITTED_H

#include "src/reference/reference_layers.h"
#include "src/reference/tracer.h"

/* Finds the objects that contain a point, by counting the surfaces along a ray to infinity. */
void whitted_find_enclosing(const struct tracer *tracing, vec3s point,
                            struct nested_media_set *inside);

/* Traces a camera ray. `forward` is the unit viewing direction; `seed` is the pixel's random seed.
 */
struct reference_ray_values whitted_trace(const struct tracer *tracing,
                                          const struct embree_scene_ray *ray, vec3s forward,
                                          uint32_t seed);

#endif
