/*
 * error_map.h: how different two pictures look: FLIP of each pixel, on a thread of its own.
 *
 * They are compared as they are shown, tonemapped, as `firn diff` compares two PNG files.
 */
#ifndef FIRN_VIEW_ERROR_MAP_H
#define FIRN_VIEW_ERROR_MAP_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include "src/image/image.h"

/* A picture: planes R, G and B of an image. */
struct error_side {
    const struct image *image;
    float scale;   /* of its values */
    bool is_shown; /* they are tonemapped */
};

struct error_map {
    pthread_t thread;
    bool runs;
    atomic_bool done;
    uint32_t width, height;
    float *planes[2]; /* R, G, B of each, one after the other */
    bool is_shown[2];
    float gain;
    uint32_t curve;
    float *errors;     /* of each pixel, 0 to 1 */
    uint8_t *rgba;     /* the same in the colours of heat.h */
    bool failed;       /* out of memory */
    double mean, high; /* high: 95 % of the pixels have no larger error */
};

void error_map_finish(struct error_map *map); /* waits for the thread; {0} is fine */

/* Compares the first with the second, of the same size; both are copied. `gain` and `curve`:
 * tonemap_apply(). Nothing may be running. False: out of memory. */
bool error_map_begin(struct error_map *map, const struct error_side sides[static 2], float gain,
                     uint32_t curve);

/* True once when it is done: `rgba` (unless it failed), `mean` and `high` are there. */
bool error_map_take(struct error_map *map);

#endif
