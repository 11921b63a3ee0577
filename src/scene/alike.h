/*
 * alike.h: detects instancing: whether triangles are a copy of others under a similarity transform.
 *
 * The transform follows from an anchor, three corners that are far apart, without a search. The
 * caller then checks that all corners match it.
 */
#ifndef FIRN_SCENE_ALIKE_H
#define FIRN_SCENE_ALIKE_H

#include <stdbool.h>
#include <stdint.h>

/* Triangle corners, accessed by index. */
struct alike_corners {
    const void *of;
    const float *(*place)(const void *of, uint32_t corner); /* returns x, y, z of a corner */
    uint32_t count;
};

struct alike_anchor {
    uint32_t corners[3];
    double length; /* squared length of the first side */
};

/* Affine 3 x 4 matrix that maps points of the first set to points of the second. */
struct alike_motion {
    double rows[3][4];
    double length; /* length of the anchor's first side in the second set */
};

struct alike_anchor alike_anchor_find(const struct alike_corners *corners);

/* Finds the transform of the anchor from `before` to `after`. Returns false if it is collinear. */
bool alike_motion_find(struct alike_motion *motion, const struct alike_anchor *anchor,
                       const struct alike_corners *before, const struct alike_corners *after);

/* Returns the error of a transformed corner: the largest difference of a coordinate. */
double alike_error(const struct alike_motion *motion, const float before[static 3],
                   const float after[static 3]);

#endif
