/* noise_estimate.c: estimates the remaining noise from running sums over blocks of pixels. */
#include "src/view/noise_estimate.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void noise_estimate_finish(struct noise_estimate *n)
{
    free(n->blocks);
    *n = (struct noise_estimate){ 0 };
}

static uint32_t blocks_of(uint32_t pixels)
{
    return (pixels + NOISE_ESTIMATE_BLOCK - 1) / NOISE_ESTIMATE_BLOCK;
}

static void begin(struct noise_estimate *n, const struct image *sums)
{
    const uint32_t columns = blocks_of(sums->width);
    const uint32_t rows = blocks_of(sums->height);
    if (n->columns != columns || n->rows != rows) {
        noise_estimate_finish(n);
        n->blocks = malloc((size_t)columns * rows * 2 * sizeof(*n->blocks));
        n->columns = n->blocks ? columns : 0;
        n->rows = rows;
    }
    if (n->columns)
        memset(n->blocks, 0, (size_t)columns * rows * 2 * sizeof(*n->blocks));
    n->count = 0;
}

/* Returns the mean of the accumulated sums over the pixels and channels of one block. */
static double mean_of(const struct image *sums, const float *const planes[3], uint32_t column,
                      uint32_t row)
{
    const uint32_t left = column * NOISE_ESTIMATE_BLOCK;
    const uint32_t top = row * NOISE_ESTIMATE_BLOCK;
    const uint32_t right =
        left + NOISE_ESTIMATE_BLOCK < sums->width ? left + NOISE_ESTIMATE_BLOCK : sums->width;
    const uint32_t bottom =
        top + NOISE_ESTIMATE_BLOCK < sums->height ? top + NOISE_ESTIMATE_BLOCK : sums->height;
    double sum = 0.0;
    for (uint32_t c = 0; c < 3; c++) {
        for (uint32_t y = top; y < bottom; y++) {
            const float *texels = &planes[c][(size_t)y * sums->width];
            for (uint32_t x = left; x < right; x++)
                sum += (double)texels[x];
        }
    }
    return sum / (3.0 * (right - left) * (bottom - top));
}

void noise_estimate_add(struct noise_estimate *n, const struct image *sums, uint32_t sample)
{
    const float *const planes[] = { image_find(sums, "R"), image_find(sums, "G"),
                                    image_find(sums, "B") };
    if (!planes[0] || !planes[1] || !planes[2])
        return;
    if (sample == 0)
        begin(n, sums);
    for (uint32_t y = 0; y < n->rows && n->columns; y++) {
        for (uint32_t x = 0; x < n->columns; x++) {
            double *block = &n->blocks[((size_t)y * n->columns + x) * 2];
            const double sum = mean_of(sums, planes, x, y);
            const double value = sum - block[0];
            block[0] = sum;
            block[1] += value * value;
        }
    }
    n->count = sample + 1;
}

double noise_estimate_now(const struct noise_estimate *n)
{
    const size_t count = (size_t)n->columns * n->rows;
    double errors = 0.0;
    if (n->count < 2 || !count)
        return -1.0;
    for (size_t b = 0; b < count; b++) {
        const double mean = n->blocks[b * 2] / n->count;
        const double variance = n->blocks[b * 2 + 1] / n->count - mean * mean;
        errors += isfinite(variance) ? sqrt(fmax(variance, 0.0) / (n->count - 1)) : 0.0;
    }
    return errors / (double)count;
}
