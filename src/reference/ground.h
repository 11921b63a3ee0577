/*
 * ground.h: light on what is around the objects, as far as it and they let it through, refract or
 * mirror it (ground.light=traced).
 *
 * A lit surface shows what it makes of a sky that nothing hides. To that, each sample adds what a
 * ray from the matt base finds, and one of the reflection, less what the sky is in their direction:
 * nothing where the way is free, so that only what is in the way makes noise (a control variate).
 * At the end of such a ray, surroundings show themselves as if nothing were in the way of their
 * light, and the sun's disc is not seen: the sun is a light of its own, which surroundings hide;
 * what objects make of it is photons' (photons.h).
 */
#ifndef FIRN_REFERENCE_GROUND_H
#define FIRN_REFERENCE_GROUND_H

#include "shaders/ground.h"
#include "src/reference/branch.h"

enum {
    GROUND_WAYS = GROUND_MATT_WAYS + 1 /* of the matt base, and of the reflection */
};

/* Branches that bring light to a point, and the light of the sky in their directions, which has
 * been counted and is to be taken away. */
struct ground_ways {
    struct branch ways[GROUND_WAYS];
    uint32_t count;
    vec3s counted;
};

/* Returns what a branch needs that has met `point` of the surroundings; `passing` is the share of
 * its light that goes through it. No ways if none are needed. */
struct ground_ways ground_gather(const struct tracing *tracing, const struct branch *b,
                                 const struct bvh_hit *hit, const struct radiance_point *point,
                                 float passing);

/* Returns the share of the sun's light that surroundings leave at a point: 0 or 1, at one point of
 * its disc, or what passes blended surfaces. */
float ground_sun(const struct tracing *tracing, vec3s point, uint32_t seed);

#endif
