/*
 * adaptive_sampling.h: adaptive sampling: more samples per pixel for the noisy cells of an image.
 *
 * Every pixel gets 4 samples. Cells (squares of ADAPTIVE_CELL pixels) then get 16 and finally 64
 * samples while they are noisy: while the root mean square of their pixels' error estimates, of
 * brightness clamped to 0..1, is above ADAPTIVE_NOISE. The error estimate of a pixel is the
 * difference between the mean of every other sample and the mean of all samples (Dammertz, Hanika,
 * Keller and Lensch 2010, A hierarchical automatic stopping condition for Monte Carlo global
 * illumination). For independent random samples it equals the standard error; for the
 * low-discrepancy samples of the pixel filters it is smaller, as the true error is.
 */
#ifndef FIRN_RENDER_ADAPTIVE_SAMPLING_H
#define FIRN_RENDER_ADAPTIVE_SAMPLING_H

#include <stdbool.h>
#include <stdint.h>
#include "src/base/tile.h"
#include "src/file/image.h"
#include "src/render/frame/output_layers.h"

#define ADAPTIVE_NOISE 0.01

enum {
    ADAPTIVE_CELL = 32,    /* pixels; even: see rg_exec_set_region() */
    ADAPTIVE_SAMPLES = 64, /* maximum number of samples per pixel */
};

struct adaptive {
    uint32_t width, height;       /* size of the image, pixels */
    uint32_t columns, rows;       /* number of cells across and down */
    float *sums, *alternate_sums; /* brightness sums of all samples, and of every second sample */
    uint32_t *counts;             /* samples drawn per cell */
    bool *is_noisy;               /* per cell: needs more samples */
    struct tile *rectangles;      /* draw these until `end` samples */
    uint32_t rectangle_count, end;
};

/* Starts with the whole image as the only rectangle. Returns false when out of memory. */
bool adaptive_init(struct adaptive *adaptive, uint32_t width, uint32_t height);
void adaptive_finish(struct adaptive *adaptive);

/* Adds one sample per pixel of a rectangle. `texels` are RGBA half floats without row padding. */
void adaptive_add(struct adaptive *adaptive, const struct tile *tile, const uint16_t *texels,
                  uint32_t sample);

/* Starts the next round after all rectangles have `end` samples per pixel. Quadruples `end` and
 * covers the noisy cells with new rectangles. Returns false if no cell is noisy. */
bool adaptive_next_round(struct adaptive *adaptive);

/* Scales an averaged layer's sample sums to ADAPTIVE_SAMPLES samples per pixel, because they need
 * one common divisor. The factors are powers of two, so nothing is rounded. */
void adaptive_rescale(const struct adaptive *adaptive, struct image *image,
                      const struct frame_layer *layer);

/* Returns the sample whose light maps a sample uses. They are redrawn by the first 4 samples, and
 * then whenever the number of samples has doubled, because redrawing them costs as much as a small
 * image, and they need fewer samples than edges. */
uint32_t adaptive_light_sample(uint32_t sample);

/* Returns the same if all pixels have equally many samples: 3 samples share the maps, so that the
 * noise of caustics still falls with the square root of the number of samples. */
uint32_t even_light_sample(uint32_t sample);

/* Returns the number of samples drawn for a pixel. */
uint32_t adaptive_count(const struct adaptive *adaptive, uint32_t x, uint32_t y);

/* Returns the number of samples per pixel, averaged over the image. */
float adaptive_mean(const struct adaptive *adaptive);

#endif
