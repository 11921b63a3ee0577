/*
 * reference_sample_sums.h: per-pixel sums over samples, for means and standard errors. They can be
 * saved to files, so that a later run can add samples.
 *
 * The brightness of a sample is the mean of red, green and blue, each clamped to 0..1. A pixel's
 * standard error is that of its mean brightness, estimated as if samples were independent.
 * Low-discrepancy samples cover a pixel more evenly, so the true error is rarely larger.
 *
 * A file stores a sum in three float planes, "R.sum.0" to "R.sum.2": the upper 22, the next 21 and
 * the lowest 21 bits of the double as integers, so that it is restored exactly. Layers that are not
 * averaged are stored under their usual names.
 */
#ifndef FIRN_LAB_REFERENCE_REFERENCE_SAMPLE_SUMS_H
#define FIRN_LAB_REFERENCE_REFERENCE_SAMPLE_SUMS_H

#include "src/base/status.h"
#include "src/file/image.h"
#include "src/lab/reference/reference_aov_table.h"

enum {
    REFERENCE_SUM_BRIGHTNESS = REFERENCE_RAY_VALUE_COUNT, /* first index after ray values */
    REFERENCE_SUM_SQUARE,                                 /* sum of squared brightness */
    REFERENCE_SUM_DISPLAY,                                /* weighted R, G, B: weighted_mean.h */
    REFERENCE_SUM_WEIGHT = REFERENCE_SUM_DISPLAY + 3,     /* weight times alpha */
    REFERENCE_VALUE_COUNT,
};

/* Standard error assumed after a single sample: the maximum for values of 0..1. */
#define REFERENCE_ERROR_UNKNOWN 0.5

struct reference_sums {
    uint32_t width, height; /* pixels */
    uint32_t samples;       /* samples added so far */
    uint32_t count;         /* sums per pixel */
    /* Indices of the summed values in struct reference_ray_values, or REFERENCE_SUM_... numbers. */
    uint32_t values[REFERENCE_VALUE_COUNT];
    double *sums;         /* `count` per pixel; may be NULL */
    uint32_t first_count; /* number of values of sample 0 */
    uint32_t first_values[REFERENCE_RAY_VALUE_COUNT];
    float *firsts[REFERENCE_RAY_VALUE_COUNT]; /* planes of first_values; borrowed */
    float weight_scale;                       /* weighted_mean_scale() */
};

/* Initialises the list of sums: brightness, squared brightness, throughput of terminated rays. */
void reference_sums_init(struct reference_sums *sums, uint32_t width, uint32_t height);
void reference_sums_finish(struct reference_sums *sums); /* accepts {0} */

/* Adds a value to the list of summed values if missing. Returns the index of its sum. */
uint32_t reference_sums_add_value(struct reference_sums *sums, uint32_t value);

/* Registers the plane `texels` for a value that is taken from sample 0 instead of averaged. */
void reference_sums_add_first(struct reference_sums *sums, uint32_t value, float *texels);

/* Allocates the sums of all pixels, initialised to 0. Returns false when out of memory. */
MUST_USE bool reference_sums_allocate(struct reference_sums *sums);

/* Adds the values of one sample to the sums of a pixel. */
void reference_sums_add(const struct reference_sums *sums, double *pixel,
                        const struct reference_ray_values *seen);

/* Returns the standard error of a pixel's mean brightness after `samples` samples. */
double reference_sums_error(const double *pixel, uint32_t samples);

/* Returns a pixel's mean throughput of terminated rays, in the largest colour channel. */
double reference_sums_remaining(const double *pixel, uint32_t samples);

/* Returns the number of planes in a file of sums. */
uint32_t reference_sums_plane_count(const struct reference_sums *sums);
void reference_sums_plane_name(const struct reference_sums *sums, uint32_t plane,
                               char name[static IMAGE_NAME_SIZE]);

/* Converts row y of the sums to a row of one plane of a file of sums. */
void reference_sums_get_row(const struct reference_sums *sums, uint32_t plane, uint32_t y,
                            float *row);

/* Restores row y of the sums from one plane of a saved file. The sums must be 0 before the first
 * plane. Call this once per row and plane. Returns false if a value is invalid. */
MUST_USE bool reference_sums_set_row(struct reference_sums *sums, uint32_t plane, uint32_t y,
                                     const float *row);

#endif
