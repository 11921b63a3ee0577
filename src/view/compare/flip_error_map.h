/* flip_error_map.h: per-pixel FLIP error of two images, computed on a worker thread. The images are
 * tone-mapped first, because FLIP compares displayed colours. `firn diff` computes equal errors for
 * PNG files. */
#ifndef FIRN_VIEW_COMPARE_FLIP_ERROR_MAP_H
#define FIRN_VIEW_COMPARE_FLIP_ERROR_MAP_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include "shaders/output/tonemap.h"
#include "src/file/image.h"

/* One of the compared images: planes R, G and B. */
struct flip_error_map_image {
    const struct image *image;
    float scale;         /* factor that scales the texels, such as 1 / sample count */
    bool is_tone_mapped; /* the planes are tone-mapped already */
};

struct flip_error_map {
    pthread_t thread;
    bool runs;
    atomic_bool done;
    uint32_t width, height;
    float *planes[2]; /* per image: R, G, B */
    bool is_tone_mapped[2];
    struct tonemap_params tonemap; /* set by the caller before flip_error_map_begin() */
    float *errors;                 /* FLIP error of each pixel, 0 to 1 */
    uint8_t *rgba;                 /* errors in false colours (heat_map.h) */
    bool failed;                   /* out of memory */
    double mean, percentile_95;    /* of the errors */
};

void flip_error_map_finish(struct flip_error_map *map); /* waits for the thread; {0} works */

/* Starts to compute the error of sides[0] relative to sides[1]. Copies both images, which must have
 * equal sizes. Must not be called while a computation is running. Returns false if out of memory.
 */
bool flip_error_map_begin(struct flip_error_map *map,
                          const struct flip_error_map_image sides[static 2]);

/* Returns true once after each computation. The results are valid unless map->failed is set. */
bool flip_error_map_take(struct flip_error_map *map);

#endif
