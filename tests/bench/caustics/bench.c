/*
 * bench.c: how far the methods of caustics are from the truth, and what they cost: a table.
 *
 * The truth is gather with many directions. Light is compared on the floor, in blocks of 4 x 4
 * texels, at three depths of a calm pool under a high sun of 2 degrees: the correlation, and in
 * parentheses the mean difference of the light, over its mean. The truth's own noise is the row of
 * a second gather that shares no directions with it: another number of them. Fails if area is not
 * nearer to the truth than backtrace.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/support/assertions.h"

#include "tests/support/caustic_map.h"

enum {
    BLOCK = 4,
    SIDE = CAUSTIC_MAP_SIZE / BLOCK,
    DEPTH_COUNT = 3,
    ASSIGNMENT_COUNT = 8,
};

struct row {
    const char *name, *method;
    const char *own; /* a setting of its own */
};

static const struct row truth = { "truth", "gather", "caustics.directions=1536" };

static const struct row rows[] = {
    { "gather, 1024", "gather", "caustics.directions=1024" },
    { "gather, 64", "gather", "caustics.directions=64" },
    { "naive, 16 million", "naive", "caustics.photons=16000000" },
    { "naive, 1 million", "naive", "caustics.photons=1000000" },
    { "area", "area", "caustics.sun=2" },
    { "backtrace, Snell", "backtrace", "caustics.slope=snell" },
    { "backtrace, published", "backtrace", "caustics.slope=published" },
};

enum {
    ROW_COUNT = sizeof(rows) / sizeof(rows[0]),
};

static const char *const depths[DEPTH_COUNT] = { "0.3", "0.6", "1.2" };

/* How a map compares with the truth. */
struct likeness {
    double correlation, difference, ms;
};

static struct light_map trace(struct gpu *gpu, const struct row *row, const char *depth,
                              uint32_t run_count)
{
    char words[32];
    const char *const assignments[ASSIGNMENT_COUNT] = {
        words, "pool.size=2.4", "water.scale=2", "caustics.sun=2", "caustics.cone=8", row->own,
        NULL,
    };
    (void)snprintf(words, sizeof(words), "pool.depth=%s", depth);
    return caustic_map_trace(
        gpu, &(struct caustic_map_params){ row->method, 90, assignments, run_count });
}

/* Mean light of a block; NAN where it is not all on the floor. */
static double block(const struct light_map *map, size_t column, size_t row)
{
    double sum = 0;
    for (size_t y = row * BLOCK; y < (row + 1) * BLOCK; y++) {
        for (size_t x = column * BLOCK; x < (column + 1) * BLOCK; x++) {
            if (fmax(fabs(caustic_map_position(map, 0, x)), fabs(caustic_map_position(map, 1, y))) >
                0.48 * map->size)
                return (double)NAN;
            sum += (double)map->texels[y * CAUSTIC_MAP_SIZE + x];
        }
    }
    return sum / (BLOCK * BLOCK);
}

static struct likeness compare(const struct light_map *a, const struct light_map *b)
{
    double count = 0, sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0, away = 0;
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
        const double x = block(a, i % SIDE, i / SIDE);
        const double y = block(b, i % SIDE, i / SIDE);
        if (isnan(x))
            continue;
        count++;
        sum_a += x;
        sum_b += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
        away += fabs(x - y);
    }
    const double covariance = ab - sum_a * sum_b / count;
    const double variances = (aa - sum_a * sum_a / count) * (bb - sum_b * sum_b / count);
    return (struct likeness){ covariance / sqrt(variances), away / sum_a, b->ms };
}

static void compare_all(struct gpu *gpu, size_t depth, struct likeness found[ROW_COUNT])
{
    struct light_map whole = trace(gpu, &truth, depths[depth], 1);
    for (size_t i = 0; i < ROW_COUNT; i++) {
        struct light_map map = trace(gpu, &rows[i], depths[depth], i ? 5 : 1);
        found[i] = compare(&whole, &map);
        free(map.texels);
    }
    free(whole.texels);
}

int main(void)
{
    struct likeness found[DEPTH_COUNT][ROW_COUNT];
    struct gpu gpu;
    bool good = true;
    if (gpu_create(&gpu, &(struct gpu_params){ 0 }) != STATUS_OK)
        return EXIT_FAILURE;
    for (size_t d = 0; d < DEPTH_COUNT; d++)
        compare_all(&gpu, d, found[d]);
    printf("%-22s", "depth, metres");
    for (size_t d = 0; d < DEPTH_COUNT; d++)
        printf(" %15s", depths[d]);
    printf(" %10s\n", "ms a map");
    for (size_t i = 0; i < ROW_COUNT; i++) {
        printf("%-22s", rows[i].name);
        for (size_t d = 0; d < DEPTH_COUNT; d++)
            printf("  %6.3f (%5.3f)", found[d][i].correlation, found[d][i].difference);
        printf(" %10.1f\n", found[DEPTH_COUNT - 1][i].ms);
    }
    for (size_t d = 0; d < DEPTH_COUNT; d++)
        good = good && found[d][4].correlation > found[d][5].correlation;
    gpu_destroy(&gpu);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
