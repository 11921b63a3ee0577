/*
 * bumps.h: bump maps of one constant slope, and the closed form of the normals that they bend.
 */
#ifndef TESTS_BUMPS_H
#define TESTS_BUMPS_H

#include "src/scene/scene.h"
#include "tests/support/vec.h"

/* Gives a scene a map of one slope along u and v, one smoothness and one height of crystals. */
void bumps_even(struct scene *scene, double slope_u, double slope_v, double smoothness,
                double crystals);

struct bumps {
    double slope_u, slope_v; /* with strength and mask */
    double turn;             /* of the object about +Y, radians */
};

/* The uneven normal seen along `e`, where the mesh's is `n`, the maps lying along three planes. */
struct vec bumps_normal(const struct bumps *bumps, struct vec n, struct vec e);

/* The same, of a gradient in the world. */
struct vec bumps_bend(struct vec gradient, struct vec n, struct vec e);

#endif
