/*
 * melt_flow.h: how the surface of ice retreats while it melts.
 *
 * Heat reaches the ice through a layer of air of thickness d. Where the surface is curved, more
 * heat reaches it: the flux is that of a flat face times 1 + d H, H the mean curvature. So edges
 * and corners grow rounder while the faces retreat evenly, and what is small melts first. A block
 * becomes a ball before it is gone.
 *
 * Errors: d is that of a tray cube, 28 mm wide, in air of 20 degrees, in proportion to the ice. The
 * ice is warmed equally from all sides. Stages of the flow are linear in between.
 */
#ifndef FIRN_SCENE_MELT_FLOW_H
#define FIRN_SCENE_MELT_FLOW_H

#include <stdbool.h>
#include <stdint.h>

/* A closed surface; points that several triangles have in common are there once. */
struct melt_flow {
    double (*points)[3];
    uint32_t count;
    const uint32_t *corners; /* three a triangle, counter-clockwise seen from outside */
    uint32_t corner_count;
};

/*
 * Lets the surface retreat until it has lost `share` of its volume, 0 to 1, and then its faces by
 * `further`, in halves of the width of a cube of its first volume. What is gone is a point. Returns
 * in *lost the share of the volume that is lost. Returns false when out of memory; the points are
 * then unchanged.
 */
bool melt_flow_run(struct melt_flow *flow, double share, double further, double *lost);

/* Returns half the width of a cube of the surface's volume. */
double melt_flow_half(const struct melt_flow *flow);

#endif
