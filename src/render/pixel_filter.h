/* pixel_filter.h: where the samples of a pixel are. */
#ifndef FIRN_RENDER_PIXEL_FILTER_H
#define FIRN_RENDER_PIXEL_FILTER_H

#include <cglm/types-struct.h>
#include <stdint.h>

enum pixel_filter {
    PIXEL_FILTER_BOX,             /* all over the pixel: the mean is that over its area */
    PIXEL_FILTER_POINT,           /* all at its centre */
    PIXEL_FILTER_BLACKMAN_HARRIS, /* dense at its centre, to 1.5 pixels aside */
    PIXEL_FILTER_COUNT,
};

/* As --pixel-filter names them. */
extern const char *const pixel_filter_names[PIXEL_FILTER_COUNT];

/*
 * Returns the offset of a sample from its pixel's centre, pixels, to the right and down. Every
 * sample has the same weight: they are as dense as the filter is high (filter importance sampling;
 * Ernst, Stamminger and Greiner 2006). Sample 0 is the centre.
 */
vec2s pixel_filter_offset(enum pixel_filter filter, uint32_t sample);

/*
 * Returns the same for the box, in [-0.5, 0.5). The samples but the first follow Roberts' R2
 * sequence, which covers the pixel evenly at any count.
 */
vec2s pixel_filter_jitter(uint32_t sample);

#endif
