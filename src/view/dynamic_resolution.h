/*
 * dynamic_resolution.h: dynamic resolution: chooses the render size while something moves, for a
 * fluid frame rate.
 *
 * The model is: seconds of a frame = F + V * (k / 16)^2, where V is the time of the image's passes
 * at full size, F everything else and k the size in sixteenths. k drops at once when frames are
 * late and rises one step at a time after a run of early frames, so that it does not oscillate.
 */
#ifndef FIRN_VIEW_DYNAMIC_RESOLUTION_H
#define FIRN_VIEW_DYNAMIC_RESOLUTION_H

#include <stdint.h>

enum {
    DYNAMIC_RESOLUTION_MIN = 4, /* in sixteenths of the full size */
    DYNAMIC_RESOLUTION_MAX = 16,
};

struct dynamic_resolution {
    uint32_t k;          /* size in sixteenths; 0 if unknown */
    uint32_t late;       /* consecutive frames longer than 33 ms */
    uint32_t since;      /* frames since k changed last */
    double passes, rest; /* smoothed V and F in seconds */
};

/* Resets the size. `passes` is the GPU time of a full-size frame in seconds, or 0 if unknown. */
void dynamic_resolution_begin(struct dynamic_resolution *m, double passes);

/* Adapts the size to the duration of a frame and the GPU time of its passes, both in seconds. */
void dynamic_resolution_add(struct dynamic_resolution *m, double frame, double passes);

/* Rounds length * k / 16 down to even. Returns `length` if k is 16 or the result would be 0. */
uint32_t dynamic_resolution_scale(uint32_t length, uint32_t k);

#endif
