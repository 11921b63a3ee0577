/* polygon_triangulate.h: triangulation of polygons by ear clipping. */
#ifndef FIRN_SCENE_IMPORT_POLYGON_TRIANGULATE_H
#define FIRN_SCENE_IMPORT_POLYGON_TRIANGULATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct polygon {
    const float *positions;    /* 3 per vertex */
    const uint32_t *vertex_of; /* corners are vertices if NULL */
    uint32_t vertex_stride;    /* elements per corner in vertex_of */
};

/* Polygon of more than three corners within an index list. */
struct polygon_range {
    /* first index of the polygon's triangle fan, and number of its corners */
    uint32_t first_index, count;
};

/* Replaces the triangle fans of polygons by ear-clipping triangulations with the same corners and
 * winding. The fan of corners c has 3 (count - 2) indices: c0 c1 c2, c0 c2 c3, ... Convex polygons
 * keep the fan; in others no triangle lies outside, if the polygon is planar and simple. Returns
 * false when out of memory. */
bool polygon_triangulate_all(const struct polygon *polygon, const struct polygon_range *polygons,
                             size_t count, uint32_t *indices);

#endif
