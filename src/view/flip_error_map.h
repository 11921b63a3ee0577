/*
 * flip_error_map.h: per-pixel FLIP error of two images, computed on a worker thread.
 *
 * FLIP is a metric of displayed colours, so both images are tone-mapped first; the result equals
 * that of `firn diff` on two PNG files.
 */
#ifndef FIRN_VIEW_FLIP_ERROR_MAP_H
#define FIRN_VIEW_FLIP_ERROR_MAP_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include "src/image/image.h"

/* One of the compared images: planes R, G and B. */
struct flip_error_map_image {
    const struct image *image;
    float scale;   /* factor on the texel values, such as 1 / sample count of a sum */
    bool is_shown; /* the planes are tone-mapped already */
};

struct flip_error_map {
    pthread_t thread;
    bool runs;
    atomic_bool done;
    uint32_t width, height;
    float *planes[2]; /* planes R, G and B of each image, one after the other */
    bool is_shown[2];
    float gain;
    uint32_t curve;
    float *errors;     /* FLIP error of each pixel, 0 to 1 */
    uint8_t *rgba;     /* errors in the false colours of heat_map.h */
    bool failed;       /* the worker thread ran out of memory */
    double mean, high; /* mean error, and the 95th percentile of the errors */
};

void flip_error_map_finish(
    struct flip_error_map *map); /* waits for the worker thread; {0} is fine */

/* Starts to compute the error of the first image relative to the second. Both have the same size
 * and are copied. `gain` and `curve` are those of tonemap_apply(). No other run may be in progress.
 * Returns false if out of memory. */
bool flip_error_map_begin(struct flip_error_map *map,
                          const struct flip_error_map_image sides[static 2], float gain,
                          uint32_t curve);

/* Returns true once when the worker is done: `rgba` (unless failed), `mean` and `high` are valid
 * then. */
bool flip_error_map_take(struct flip_error_map *map);

#endif
