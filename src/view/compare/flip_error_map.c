/* flip_error_map.c: computes a FLIP error map of two images on a worker thread. */
#include "src/view/compare/flip_error_map.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/lab/metric/flip.h"
#include "src/lab/metric/heat_map.h"
#include "src/lab/metric/quantile.h"
#include "src/view/window/window.h"

static const double most = 0.95; /* quantile of `percentile_95` */

static void forget(struct flip_error_map *map)
{
    for (size_t s = 0; s < 2; s++) {
        free(map->planes[s]);
        map->planes[s] = NULL;
    }
    free(map->errors);
    free(map->rgba);
    map->errors = NULL;
    map->rgba = NULL;
}

void flip_error_map_finish(struct flip_error_map *map)
{
    if (map->runs)
        pthread_join(map->thread, NULL);
    map->runs = false;
    forget(map);
}

static bool copy(struct flip_error_map *map, size_t side, const struct flip_error_map_image *from)
{
    static const char *const names[] = { "R", "G", "B" };
    const size_t size = (size_t)map->width * map->height;
    map->planes[side] = malloc(size * 3 * sizeof(float));
    map->is_tone_mapped[side] = from->is_tone_mapped;
    for (size_t c = 0; c < 3 && map->planes[side]; c++) {
        const float *texels = image_find(from->image, names[c]);
        for (size_t i = 0; i < size; i++)
            map->planes[side][c * size + i] = texels ? texels[i] * from->scale : 0.0f;
    }
    return map->planes[side] != NULL;
}

static void show(struct flip_error_map *map, size_t side)
{
    const size_t size = (size_t)map->width * map->height;
    float *p = map->planes[side];
    for (size_t i = 0; i < size && !map->is_tone_mapped[side]; i++) {
        const vec3s linear = { { p[i], p[size + i], p[2 * size + i] } };
        const vec3s shown = tonemap_apply(linear, map->tonemap);
        for (size_t c = 0; c < 3; c++)
            p[c * size + i] = shown.raw[c];
    }
}

static void colour(struct flip_error_map *map)
{
    const size_t size = (size_t)map->width * map->height;
    double sum = 0.0;
    for (size_t i = 0; i < size; i++) {
        heat_map_srgb(map->errors[i], &map->rgba[i * 4]);
        map->rgba[i * 4 + 3] = 255;
        sum += (double)map->errors[i];
    }
    map->mean = sum / (double)size;
    quantile_sort(map->errors, size);
    map->percentile_95 = quantile_at(map->errors, size, most);
}

static void *run(void *user)
{
    struct flip_error_map *map = user;
    const size_t size = (size_t)map->width * map->height;
    struct flip_pair pair = { .width = map->width, .height = map->height, .ppd = FLIP_PPD };
    for (size_t s = 0; s < 2; s++)
        show(map, s);
    for (size_t c = 0; c < 3; c++) {
        pair.test[c] = &map->planes[0][c * size];
        pair.reference[c] = &map->planes[1][c * size];
    }
    map->errors = malloc(size * sizeof(*map->errors));
    map->rgba = malloc(size * 4);
    map->failed = !map->errors || !map->rgba || !flip_ldr(&pair, 0.0, map->errors);
    if (!map->failed)
        colour(map);
    atomic_store(&map->done, true);
    window_wake();
    return NULL;
}

bool flip_error_map_begin(struct flip_error_map *map,
                          const struct flip_error_map_image sides[static 2])
{
    forget(map);
    map->width = sides[0].image->width;
    map->height = sides[0].image->height;
    map->failed = false;
    atomic_store(&map->done, false);
    if (copy(map, 0, &sides[0]) && copy(map, 1, &sides[1]))
        map->runs = pthread_create(&map->thread, NULL, run, map) == 0;
    if (!map->runs)
        forget(map);
    return map->runs;
}

bool flip_error_map_take(struct flip_error_map *map)
{
    if (!map->runs || !atomic_load(&map->done))
        return false;
    pthread_join(map->thread, NULL);
    map->runs = false;
    return true;
}
