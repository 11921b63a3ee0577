/*
 * adaptive.h: which parts of a picture get more samples.
 *
 * A picture has 4 samples everywhere. Its cells, squares of ADAPTIVE_CELL pixels, go on to 16 and
 * to 64 while their mean is not known well: while the root mean square of their pixels' errors, of
 * brightness clipped to 0..1, is above ADAPTIVE_NOISE. A pixel's error is how far the mean of every
 * other sample is from that of all (Dammertz, Hanika, Keller and Lensch 2010, A hierarchical
 * automatic stopping condition for Monte Carlo global illumination); of random samples that is
 * their standard error, of samples as even as those of pixel filters it is less, as it should be.
 */
#ifndef FIRN_RENDER_ADAPTIVE_H
#define FIRN_RENDER_ADAPTIVE_H

#include <stdbool.h>
#include <stdint.h>
#include "src/base/tile.h"
#include "src/frame/layers.h"
#include "src/image/image.h"

#define ADAPTIVE_NOISE 0.01

enum {
    ADAPTIVE_CELL = 32,    /* pixels; even: see rg_exec_set_region() */
    ADAPTIVE_SAMPLES = 64, /* at most */
};

struct adaptive {
    uint32_t width, height; /* pixels of the picture */
    uint32_t columns, rows; /* of cells */
    float *sums, *halves;   /* of each pixel: brightness of all samples, of every other one */
    uint32_t *counts;       /* samples of each cell */
    bool *asks;             /* of each cell: it goes on */
    struct tile *parts;     /* rectangles of cells that get the samples up to: */
    uint32_t part_count, end;
};

/* Begins with the first samples of the whole picture. Returns false when out of memory. */
bool adaptive_init(struct adaptive *adaptive, uint32_t width, uint32_t height);
void adaptive_finish(struct adaptive *adaptive);

/* Adds a sample of a part: its texels, RGBA of half, rows tight. */
void adaptive_add(struct adaptive *adaptive, const struct tile *part, const uint16_t *texels,
                  uint32_t sample);

/* After the samples up to `end` of all parts: finds the next end and its parts. Returns false if
 * no cell goes on. */
bool adaptive_go_on(struct adaptive *adaptive);

/* Multiplies the sums of an averaged layer's samples, of cells with fewer than ADAPTIVE_SAMPLES, so
 * that all are divided by these. Powers of two, so the means stay those of fewer samples. */
void adaptive_even(const struct adaptive *adaptive, struct image *image,
                   const struct frame_layer *layer);

/* Returns the samples of a pixel. */
uint32_t adaptive_count(const struct adaptive *adaptive, uint32_t x, uint32_t y);

/* Returns the samples of a pixel, on average. */
float adaptive_mean(const struct adaptive *adaptive);

#endif
