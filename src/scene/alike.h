/*
 * alike.h: whether triangles are others that have been moved, turned and scaled evenly.
 *
 * Three corners that are far from each other, the anchor, tell the motion; whether all corners
 * follow it, the caller decides.
 */
#ifndef FIRN_SCENE_ALIKE_H
#define FIRN_SCENE_ALIKE_H

#include <stdbool.h>
#include <stdint.h>

/* The corners of triangles, by number. */
struct alike_corners {
    const void *of;
    const float *(*place)(const void *of, uint32_t corner); /* x, y, z */
    uint32_t count;
};

struct alike_anchor {
    uint32_t corners[3];
    double length; /* squared, of the first side */
};

/* A point of the corners before, to one of those after. */
struct alike_motion {
    double rows[3][4];
    double length; /* of the anchor's first side, after */
};

struct alike_anchor alike_anchor_find(const struct alike_corners *corners);

/* Finds the motion of an anchor. Returns false if it is on a line. */
bool alike_motion_find(struct alike_motion *motion, const struct alike_anchor *anchor,
                       const struct alike_corners *before, const struct alike_corners *after);

/* Returns how far a corner is from where the motion puts it, in its farthest coordinate. */
double alike_error(const struct alike_motion *motion, const float before[static 3],
                   const float after[static 3]);

#endif
