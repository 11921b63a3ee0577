/*
 * whitted.h: recursive ray tracing through a scene's objects (Whitted).
 *
 * At a smooth surface light is reflected and refracted by Fresnel's equations and Snell's law, with
 * the indices of the media on both sides (media.h); at a rough one, a sample of a pixel meets one
 * microfacet (microfacet.h). Both branches are traced until their weight is below reference.cutoff
 * or they have met reference.bounces surfaces. Pictures of smooth objects use no random numbers.
 *
 * With reference.roulette those go on instead, one way of the two at each surface by chance; the
 * weak ones among them only by chance, with the weight of the others (Russian roulette).
 *
 * A crack in an object is a thin gap of what is outside: it reflects 2 R / (1 + R), and what passes
 * it keeps its direction. A plane of air covers what is behind it by its opacity. Outside of
 * objects both are nothing.
 *
 * Bumps bend the normals of objects, and frost is in a random share of a pixel's samples.
 *
 * Where air is a medium (cloud.h), light is scattered at random. From then on a branch is one path,
 * which a surface reflects or refracts by chance, so that no tree grows.
 *
 * Limits: with interpolated normals a direction may be on the wrong side of a triangle: light then
 * continues in that direction, as from the smooth surface, and does not meet the object from the
 * side on which it is not; only light that is reflected inside is reflected by the triangle's own
 * normal instead.
 */
#ifndef FIRN_REFERENCE_WHITTED_H
#define FIRN_REFERENCE_WHITTED_H

#include "src/reference/reference_layers.h"
#include "src/reference/tracing.h"

/* Finds the objects that a point is inside, by the surfaces between it and infinity. */
void whitted_immerse(const struct tracing *tracing, vec3s point, struct media_set *inside);

/* Traces a ray from the eye. `forward` is the view's axis, unit; `seed` is the pixel's. */
struct reference_seen whitted_trace(const struct tracing *tracing, const struct bvh_ray *ray,
                                    vec3s forward, uint32_t seed);

#endif
