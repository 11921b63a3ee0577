/* adaptive_sampling.c: finds the noisy cells of an image, and covers them with rectangles. */
#include "src/render/adaptive_sampling.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/half_float.h"

enum {
    CELL = ADAPTIVE_CELL,
    LIGHT_SHARED = 3,    /* number of samples that share the light maps */
    FIRST_END = 4,       /* samples per pixel in round 1; later rounds quadruple the total */
    RECTANGLE_COST = 64, /* fixed cost of drawing a rectangle, as a number of cells */
};

bool adaptive_init(struct adaptive *adaptive, uint32_t width, uint32_t height)
{
    struct adaptive a = {
        .width = width,
        .height = height,
        .columns = (width + CELL - 1) / CELL,
        .rows = (height + CELL - 1) / CELL,
        .rectangle_count = 1,
        .end = FIRST_END,
    };
    const size_t pixels = (size_t)width * height, cells = (size_t)a.columns * a.rows;
    a.sums = calloc(pixels, sizeof(*a.sums));
    a.alternate_sums = calloc(pixels, sizeof(*a.alternate_sums));
    a.counts = calloc(cells, sizeof(*a.counts));
    a.is_noisy = calloc(cells, sizeof(*a.is_noisy));
    a.rectangles = calloc(cells, sizeof(*a.rectangles));
    *adaptive = a;
    if (!a.sums || !a.alternate_sums || !a.counts || !a.is_noisy || !a.rectangles) {
        adaptive_finish(adaptive);
        return false;
    }
    a.rectangles[0] = (struct tile){ .width = width, .height = height };
    return true;
}

void adaptive_finish(struct adaptive *adaptive)
{
    free(adaptive->sums);
    free(adaptive->alternate_sums);
    free(adaptive->counts);
    free(adaptive->is_noisy);
    free(adaptive->rectangles);
    *adaptive = (struct adaptive){ 0 };
}

static float brightness(const uint16_t *rgba)
{
    float sum = 0.0f;
    for (int c = 0; c < 3; c++)
        sum += fminf(fmaxf(half_to_float(rgba[c]), 0.0f), 1.0f); /* fmaxf() turns NaN into 0 */
    return sum / 3.0f;
}

void adaptive_add(struct adaptive *adaptive, const struct tile *tile, const uint16_t *texels,
                  uint32_t sample)
{
    for (uint32_t y = 0; y < tile->height; y++) {
        const size_t row = (size_t)(tile->y + y) * adaptive->width + tile->x;
        for (uint32_t x = 0; x < tile->width; x++) {
            const float b = brightness(&texels[4 * ((size_t)y * tile->width + x)]);
            adaptive->sums[row + x] += b;
            adaptive->alternate_sums[row + x] += sample % 2 ? 0.0f : b;
        }
    }
    for (uint32_t y = tile->y / CELL; y * CELL < tile->y + tile->height; y++) {
        for (uint32_t x = tile->x / CELL; x * CELL < tile->x + tile->width; x++)
            adaptive->counts[y * adaptive->columns + x]++;
    }
}

/* Converts a rectangle of cells to pixels, clipped to the image. */
static struct tile pixels_of(const struct adaptive *a, const struct tile *cells)
{
    struct tile tile = { cells->x * CELL, cells->y * CELL, cells->width * CELL,
                         cells->height * CELL };
    tile.width = tile.width < a->width - tile.x ? tile.width : a->width - tile.x;
    tile.height = tile.height < a->height - tile.y ? tile.height : a->height - tile.y;
    return tile;
}

/* Returns the mean square of the error estimates of a cell's pixels. */
static double squared_error(const struct adaptive *a, uint32_t column, uint32_t row)
{
    const struct tile pixels = pixels_of(a, &(struct tile){ column, row, 1, 1 });
    const double n = a->counts[row * a->columns + column];
    double sum = 0.0;
    for (uint32_t y = pixels.y; y < pixels.y + pixels.height; y++) {
        for (uint32_t x = pixels.x; x < pixels.x + pixels.width; x++) {
            const size_t i = (size_t)y * a->width + x;
            const double error = ((double)a->sums[i] - 2.0 * (double)a->alternate_sums[i]) / n;
            sum += error * error;
        }
    }
    return sum / ((double)pixels.width * pixels.height);
}

/* Shrinks *cells to the bounding rectangle of its noisy cells. Returns false if there are none. */
static bool shrink(const struct adaptive *a, struct tile *cells)
{
    uint32_t left = UINT32_MAX, top = UINT32_MAX, right = 0, bottom = 0;
    for (uint32_t y = cells->y; y < cells->y + cells->height; y++) {
        for (uint32_t x = cells->x; x < cells->x + cells->width; x++) {
            if (!a->is_noisy[y * a->columns + x])
                continue;
            left = x < left ? x : left;
            right = x > right ? x : right;
            top = y < top ? y : top;
            bottom = y;
        }
    }
    if (left <= right)
        *cells = (struct tile){ left, top, right - left + 1, bottom - top + 1 };
    return left <= right;
}

/* Covers the noisy pixel blocks (cells) in `cells` with rectangles to draw. Returns their total
 * cost, in cells. If halving `cells` lowers the cost, halves it recursively. */
static uint32_t cover(struct adaptive *a, struct tile cells)
{
    const uint32_t before = a->rectangle_count;
    uint32_t split = UINT32_MAX;
    if (!shrink(a, &cells))
        return 0;
    const uint32_t whole = cells.width * cells.height + RECTANGLE_COST;
    if (whole > 2 * RECTANGLE_COST) {
        struct tile first = cells, second = cells;
        if (cells.width > cells.height) {
            first.width /= 2;
            second.x += first.width;
            second.width -= first.width;
        } else {
            first.height /= 2;
            second.y += first.height;
            second.height -= first.height;
        }
        split = cover(a, first) + cover(a, second);
    }
    if (split < whole)
        return split;
    a->rectangle_count = before;
    a->rectangles[a->rectangle_count++] = pixels_of(a, &cells);
    return whole;
}

bool adaptive_next_round(struct adaptive *adaptive)
{
    struct adaptive *a = adaptive;
    for (uint32_t y = 0; y < a->rows; y++) {
        for (uint32_t x = 0; x < a->columns; x++)
            a->is_noisy[y * a->columns + x] =
                a->counts[y * a->columns + x] == a->end &&
                squared_error(a, x, y) > ADAPTIVE_NOISE * ADAPTIVE_NOISE;
    }
    a->rectangle_count = 0;
    if (a->end == ADAPTIVE_SAMPLES)
        return false;
    a->end *= 4;
    return cover(a, (struct tile){ 0, 0, a->columns, a->rows }) > 0;
}

uint32_t adaptive_light_sample(uint32_t sample)
{
    uint32_t redrawn = FIRST_END;
    while (2 * redrawn <= sample)
        redrawn *= 2;
    return sample < FIRST_END ? sample : redrawn;
}

uint32_t even_light_sample(uint32_t sample)
{
    return sample / LIGHT_SHARED * LIGHT_SHARED;
}

uint32_t adaptive_count(const struct adaptive *adaptive, uint32_t x, uint32_t y)
{
    return adaptive->counts[y / CELL * adaptive->columns + x / CELL];
}

void adaptive_rescale(const struct adaptive *adaptive, struct image *image,
                      const struct frame_layer *layer)
{
    for (uint32_t p = 0; p < frame_layer_plane_count(layer) && layer->mean; p++) {
        float *plane = image_find(image, layer->planes[p]);
        for (size_t i = 0; plane && i < (size_t)adaptive->width * adaptive->height; i++) {
            const uint32_t count = adaptive_count(adaptive, (uint32_t)(i % adaptive->width),
                                                  (uint32_t)(i / adaptive->width));
            plane[i] *= (float)ADAPTIVE_SAMPLES / (float)count;
        }
    }
}

float adaptive_mean(const struct adaptive *adaptive)
{
    double sum = 0.0;
    for (uint32_t y = 0; y < adaptive->rows; y++) {
        for (uint32_t x = 0; x < adaptive->columns; x++) {
            const struct tile pixels = pixels_of(adaptive, &(struct tile){ x, y, 1, 1 });
            sum +=
                (double)adaptive->counts[y * adaptive->columns + x] * pixels.width * pixels.height;
        }
    }
    return (float)(sum / ((double)adaptive->width * adaptive->height));
}
