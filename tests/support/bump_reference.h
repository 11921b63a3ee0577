/* bump_reference.h: bump maps of constant slope, and their perturbed normals in closed form. */
#ifndef TESTS_SUPPORT_BUMP_REFERENCE_H
#define TESTS_SUPPORT_BUMP_REFERENCE_H

#include "src/scene/scene.h"
#include "tests/support/vec.h"

/* Replaces a scene's bump map by one of constant slopes, smoothness and frost height. */
void bump_reference_make_constant(struct scene *scene, double slope_u, double slope_v,
                                  double smoothness, double crystals);

struct bumps {
    double slope_u, slope_v; /* bump slopes, already scaled by strength and mask */
    double turn;             /* rotation of the object about +Y, radians */
};

/* Returns the shading normal for mesh normal `n` and view direction `e` with triplanar mapping. */
struct vec bump_reference_normal(const struct bumps *bumps, struct vec n, struct vec e);

/* Perturbs normal `n` by a world-space height gradient; keeps it facing the view direction `e`. */
struct vec bump_reference_perturb(struct vec gradient, struct vec n, struct vec e);

#endif
