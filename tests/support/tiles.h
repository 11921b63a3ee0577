/*
 * tiles.h: rays through a picture's pixels against a mesh, without trying every triangle: only
 * those whose corners' bounds in the picture touch the tile of the pixel. What is left out could
 * not be met, so the answer is that of trying all.
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
