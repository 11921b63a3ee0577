/*
 * moving.h: how large the picture is drawn while something moves, so that it is fluid.
 *
 * A frame takes F + V * (k / 16)^2 seconds: V the passes of the picture at full size, F all else. k
 * goes down at once when frames are late, and up a step at a time when they have been early for a
 * while, so that it does not swing.
 */
#ifndef FIRN_VIEW_MOVING_H
#define FIRN_VIEW_MOVING_H

#include <stdint.h>

enum {
    MOVING_LEAST = 8, /* sixteenths of the picture's width and height */
    MOVING_MOST = 16,
};

struct moving {
    uint32_t k;          /* sixteenths of the next frame; 0: not known */
    uint32_t late;       /* frames in a row over 33 ms */
    uint32_t since;      /* frames since k was another one */
    double passes, rest; /* V and F, seconds; smoothed */
};

/* Begins again: `passes` seconds was the last picture in full size; 0: nobody knows. */
void moving_begin(struct moving *moving, double passes);

/* A frame drawn with moving->k took so many seconds, of which the picture's passes took some. */
void moving_add(struct moving *moving, double frame, double passes);

/* So much of a length, pixels; even, at least 2 unless the length is less. */
uint32_t moving_part(uint32_t length, uint32_t k);

#endif
