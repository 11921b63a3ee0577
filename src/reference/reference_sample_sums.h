/*
 * reference_sample_sums.h: per-pixel sums over samples, from which the means and standard errors of
 * an image follow. They are saved to files, so that a later run can add samples.
 *
 * The brightness of a sample is the mean of red, green and blue, each clamped to 0..1. The standard
 * error of a pixel is that of its mean brightness, estimated as if samples were independent.
 * Low-discrepancy samples cover the pixel more evenly, so the true error is rarely larger.
 *
 * In files a sum occupies three float planes, "R.sum.0" to "R.sum.2". They store the upper 22, the
 * next 21 and the lowest 21 bits of its double as integers, so that the value is restored exactly.
 * Layers that are not averaged are stored as planes of their usual names.
 */
#ifndef FIRN_REFERENCE_REFERENCE_SAMPLE_SUMS_H
#define FIRN_REFERENCE_REFERENCE_SAMPLE_SUMS_H

#include "src/base/status.h"
#include "src/image/image.h"
#include "src/reference/reference_layers.h"

enum {
    REFERENCE_SUM_BRIGHTNESS =
        REFERENCE_RAY_VALUE_COUNT, /* first index after the values of a ray */
    REFERENCE_SUM_SQUARE,          /* sum of squared brightness */
    REFERENCE_VALUE_COUNT,
};

/* Stands in for the undefined standard error of one sample; no mean of 0..1 has a larger error. */
#define REFERENCE_ERROR_UNKNOWN 0.5

struct reference_sums {
    uint32_t width, height; /* pixels */
    uint32_t samples;       /* samples added so far */
    uint32_t count;         /* number of sums per pixel; values[i] is what sum i adds up: */
    /* float of struct reference_ray_values by index, or REFERENCE_SUM_... */
    uint32_t values[REFERENCE_VALUE_COUNT];
    double *sums;         /* `count` per pixel; NULL if the sums are not kept */
    uint32_t first_count; /* values of sample 0 alone; first_values[i] says which: */
    uint32_t first_values[REFERENCE_RAY_VALUE_COUNT];
    float *firsts[REFERENCE_RAY_VALUE_COUNT]; /* image planes with these values; borrowed */
};

/* Initialises with the sums that every image needs: brightness, squared brightness and `remaining`.
 */
void reference_sums_init(struct reference_sums *sums, uint32_t width, uint32_t height);
void reference_sums_finish(struct reference_sums *sums); /* accepts {0} */

/* Adds a value to the list of sums unless it is already there. Returns the index of its sum. */
uint32_t reference_sums_want(struct reference_sums *sums, uint32_t value);

/* Adds a value of sample 0 to the list, with the image plane that stores it. */
void reference_sums_want_first(struct reference_sums *sums, uint32_t value, float *texels);

/* Allocates the sums of all pixels, initialised to 0. Returns false when out of memory. */
MUST_USE bool reference_sums_keep(struct reference_sums *sums);

/* Adds the values of one sample to the sums of a pixel. */
void reference_sums_add(const struct reference_sums *sums, double *pixel,
                        const struct reference_ray_values *seen);

/* Returns the standard error of a pixel's mean brightness after `samples` samples. */
double reference_sums_error(const double *pixel, uint32_t samples);

/* Returns the largest channel of a pixel's mean `remaining`. */
double reference_sums_remaining(const double *pixel, uint32_t samples);

/* Number of planes in a file, and the name of each. */
uint32_t reference_sums_plane_count(const struct reference_sums *sums);
void reference_sums_plane_name(const struct reference_sums *sums, uint32_t plane,
                               char name[static IMAGE_NAME_SIZE]);

/* Fills `row` with row y of a file's plane. */
void reference_sums_get_row(const struct reference_sums *sums, uint32_t plane, uint32_t y,
                            float *row);

/* Restores row y of a file's plane; the sums must still be 0 and every row must be given once.
 * Returns false if a value is not one that reference_sums_get_row() writes. */
MUST_USE bool reference_sums_put_row(struct reference_sums *sums, uint32_t plane, uint32_t y,
                                     const float *row);

#endif
