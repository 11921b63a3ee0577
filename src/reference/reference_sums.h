/*
 * reference_sums.h: the sums over a pixel's samples, from which its means and its error follow.
 *
 * A sample's brightness is the mean of its red, green and blue, each clipped to 0..1. The standard
 * error of a pixel is that of the mean of its samples' brightness, as if they were independent.
 * They cover the pixel evenly, so that the true error is rarely larger.
 *
 * In files a sum is three planes of float, "R.sum.0" to "R.sum.2", which hold the upper 22, the
 * next 21 and the last 21 bits of its double as whole numbers, so that no bit is lost. Layers that
 * are no means are planes of their usual names.
 */
#ifndef FIRN_REFERENCE_REFERENCE_SUMS_H
#define FIRN_REFERENCE_REFERENCE_SUMS_H

#include "src/base/status.h"
#include "src/image/image.h"
#include "src/reference/reference_layers.h"

enum {
    REFERENCE_SUM_BRIGHTNESS = REFERENCE_SEEN_COUNT, /* after the values of a ray */
    REFERENCE_SUM_SQUARE,                            /* of the brightness */
    REFERENCE_VALUE_COUNT,
};

/* The standard error of a mean of one sample, which is not known: no mean of 0..1 has a larger. */
#define REFERENCE_ERROR_UNKNOWN 0.5

struct reference_sums {
    uint32_t width, height;                 /* pixels */
    uint32_t samples;                       /* in the sums */
    uint32_t count;                         /* sums of a pixel, each of: */
    uint32_t values[REFERENCE_VALUE_COUNT]; /* a float of struct reference_seen by its index, or
                                               REFERENCE_SUM_... */
    double *sums;                           /* `count` for each pixel; NULL: they are not kept */
    uint32_t first_count;                   /* values that only sample 0 has, each of: */
    uint32_t first_values[REFERENCE_SEEN_COUNT];
    float *firsts[REFERENCE_SEEN_COUNT]; /* planes of the picture; borrowed */
};

/* Begins with the sums that every picture needs: brightness, its square and `remaining`. */
void reference_sums_init(struct reference_sums *sums, uint32_t width, uint32_t height);
void reference_sums_finish(struct reference_sums *sums); /* {0} is fine */

/* Adds a value to those that are summed, unless it is there. Returns the index of its sum. */
uint32_t reference_sums_want(struct reference_sums *sums, uint32_t value);

/* Adds a value of sample 0, and where it is. */
void reference_sums_want_first(struct reference_sums *sums, uint32_t value, float *texels);

/* Keeps the sums of all pixels, now 0. Returns false when out of memory. */
MUST_USE bool reference_sums_keep(struct reference_sums *sums);

/* Adds a sample to the sums of a pixel. */
void reference_sums_add(const struct reference_sums *sums, double *pixel,
                        const struct reference_seen *seen);

/* Returns the standard error of a pixel's mean brightness, by so many samples. */
double reference_sums_error(const double *pixel, uint32_t samples);

/* Returns the largest mean of a pixel's `remaining`. */
double reference_sums_remaining(const double *pixel, uint32_t samples);

/* ---- in files ---- */

/* Planes of a file, and the name of each. */
uint32_t reference_sums_plane_count(const struct reference_sums *sums);
void reference_sums_plane_name(const struct reference_sums *sums, uint32_t plane,
                               char name[static IMAGE_NAME_SIZE]);

/* Fills a row of a plane. */
void reference_sums_get_row(const struct reference_sums *sums, uint32_t plane, uint32_t y,
                            float *row);

/* Takes a row of a plane over, once, into sums that are still 0. Returns false if it has other
 * numbers than reference_sums_get_row() makes. */
MUST_USE bool reference_sums_put_row(struct reference_sums *sums, uint32_t plane, uint32_t y,
                                     const float *row);

#endif
