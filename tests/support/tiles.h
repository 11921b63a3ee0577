/*
 * tiles.h: intersects rays through a picture's pixels with a mesh. Only triangles whose bounds in
 * the picture overlap the pixel's tile are tested; others cannot be hit, so the result is exact.
 */
#ifndef TESTS_TILES_H
#define TESTS_TILES_H

#include <stdint.h>

#include "tests/support/picture.h"

struct tiles {
    const struct mesh *mesh;
    const struct picture_request *request; /* borrowed, as the mesh */
    uint32_t columns;
    uint32_t *first;   /* of a tile's, and one more */
    uint32_t *corners; /* of each triangle the first, as in mesh->indices */
};

/* The whole mesh must be before the eye. */
void tiles_init(struct tiles *tiles, const struct mesh *mesh,
                const struct picture_request *request);
void tiles_finish(struct tiles *tiles);

/* Where the ray through the centre of pixel i meets the mesh: distances, in no order. */
size_t tiles_trace(const struct tiles *tiles, size_t i, double *hits, size_t hits_max);

#endif
