/* fit_similarity.h: computes the similarity transform between two sets of triangles, to detect
 * instances. Three corners that are far apart determine the transform without a search. The caller
 * then checks that the transform maps all corners correctly. */
#ifndef FIRN_SCENE_GEOMETRY_FIT_SIMILARITY_H
#define FIRN_SCENE_GEOMETRY_FIT_SIMILARITY_H

#include <stdbool.h>
#include <stdint.h>

/* Triangle corners, accessed by index through a callback. */
struct similarity_transform_corners {
    const void *context;
    const float *(*position)(const void *context,
                             uint32_t corner); /* returns a corner's x, y and z */
    uint32_t count;
};

struct similarity_transform_anchor {
    uint32_t corners[3];
    double length; /* squared length of the first side */
};

/* Affine 3 x 4 matrix that maps points of the first set to points of the second. */
struct similarity_transform {
    double rows[3][4];
    double length; /* distance between the anchor's first two corners in the second set */
};

struct similarity_transform_anchor
similarity_transform_anchor_find(const struct similarity_transform_corners *corners);

/* Finds the transform from `before` to `after`. Returns false if the anchor is collinear. */
bool similarity_transform_find(struct similarity_transform *motion,
                               const struct similarity_transform_anchor *anchor,
                               const struct similarity_transform_corners *before,
                               const struct similarity_transform_corners *after);

/* Returns the largest coordinate error of a transformed corner. */
double similarity_transform_error(const struct similarity_transform *motion,
                                  const float before[static 3], const float after[static 3]);

#endif
