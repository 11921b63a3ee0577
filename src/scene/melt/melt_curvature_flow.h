/*
 * melt_curvature_flow.h: retreat of an ice surface while it melts, by mean-curvature flow.
 *
 * Model: heat reaches the ice by conduction through a layer of air of thickness d. Curvature
 * increases the heat flux, to 1 + d H times that of a flat face, where H is the mean curvature.
 * Edges and corners therefore round off while faces retreat evenly, and small features melt first.
 * A block becomes a sphere before it vanishes.
 *
 * Limits: d is that of an ice cube 28 mm wide in air of 20 degrees, scaled with the ice. Heat comes
 * equally from all sides. States between two time steps are interpolated linearly.
 */
#ifndef FIRN_SCENE_MELT_MELT_CURVATURE_FLOW_H
#define FIRN_SCENE_MELT_MELT_CURVATURE_FLOW_H

#include <stdbool.h>
#include <stdint.h>

/* Closed surface with welded points. */
struct melt_curvature_flow {
    double (*points)[3];
    uint32_t count;
    const uint32_t *corners; /* three points per triangle, counter-clockwise from outside */
    uint32_t corner_count;
};

/* Melts the surface until it has lost the fraction `fraction` of its volume, 0 to 1, then moves its
 * faces inwards by `further`, in half widths of a cube of the initial volume. Ice that vanishes
 * collapses to a point. *lost receives the lost volume fraction. Returns false when out of memory;
 * the points are then unchanged. */
bool melt_curvature_flow_run(struct melt_curvature_flow *flow, double fraction, double further,
                             double *lost);

/* Returns half the width of a cube with the surface's volume. */
double melt_curvature_flow_half_width(const struct melt_curvature_flow *flow);

#endif
