/*
 * screen_tiles.h: intersects camera rays with a mesh, accelerated by screen tiles. Only triangles
 * whose screen bounds overlap the pixel's tile are tested; the others cannot be hit.
 */
#ifndef TESTS_SUPPORT_SCREEN_TILES_H
#define TESTS_SUPPORT_SCREEN_TILES_H

#include <stdint.h>

#include "tests/support/picture.h"

struct tiles {
    const struct mesh *mesh;
    const struct picture_request *request; /* borrowed, as is the mesh */
    uint32_t columns;
    uint32_t *first;   /* start of each tile's list in `corners`, then the end of the last list */
    uint32_t *corners; /* first index of each triangle in mesh->indices */
};

/* Builds the lists. The whole mesh must be in front of the camera. */
void screen_tiles_init(struct tiles *tiles, const struct mesh *mesh,
                       const struct picture_request *request);
void screen_tiles_finish(struct tiles *tiles);

/* Intersects the camera ray of pixel i. Writes unsorted distances, and returns their number. */
size_t screen_tiles_trace(const struct tiles *tiles, size_t i, double *hits, size_t hits_max);

#endif
