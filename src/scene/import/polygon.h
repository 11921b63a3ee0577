/* polygon.h: divides a polygon into triangles. */
#ifndef FIRN_SCENE_IMPORT_POLYGON_H
#define FIRN_SCENE_IMPORT_POLYGON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct polygon {
    const float *positions;    /* 3 of each vertex */
    const uint32_t *vertex_of; /* of each corner; NULL: a corner is the number of its vertex */
    uint32_t vertex_stride;    /* from one corner to the next; 1: the array is dense */
};

/*
 * Replaces a fan by better triangles of the same corners and winding. On entry the fan of a polygon
 * of `count` corners c is in `indices`, which has 3 (count - 2) elements: c0 c1 c2, c0 c2 c3, ...
 * Convex polygons keep the fan; of others, ears are cut, so that no triangle is outside, where the
 * polygon is flat and its sides do not cross. Returns false when out of memory.
 */
bool polygon_divide(const struct polygon *polygon, uint32_t *indices, uint32_t count);

/* A polygon of more than three corners in a list of indices. */
struct polygon_at {
    uint32_t first_index, count; /* of its fan; corners */
};

/* Divides all polygons of a list. Returns false when out of memory. */
bool polygon_divide_all(const struct polygon *polygon, const struct polygon_at *polygons,
                        size_t count, uint32_t *indices);

#endif
