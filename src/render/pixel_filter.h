/* pixel_filter.h: pixel reconstruction filters, as sample positions within a pixel. */
#ifndef FIRN_RENDER_PIXEL_FILTER_H
#define FIRN_RENDER_PIXEL_FILTER_H

#include <cglm/types-struct.h>
#include <stdint.h>

enum pixel_filter {
    PIXEL_FILTER_BOX,             /* uniform over the pixel area */
    PIXEL_FILTER_POINT,           /* every sample at the pixel centre */
    PIXEL_FILTER_BLACKMAN_HARRIS, /* Blackman-Harris window, radius 1.5 pixels */
    PIXEL_FILTER_COUNT,
};

/* Names of the filters, which are the values of --pixel-filter. */
extern const char *const pixel_filter_names[PIXEL_FILTER_COUNT];

/* Returns the offset of a sample from the pixel centre, in pixels to the right and down. Sample 0
 * is at the centre. The density of samples follows the filter, so that all have the same weight
 * (filter importance sampling; Ernst, Stamminger and Greiner 2006). */
vec2s pixel_filter_offset(enum pixel_filter filter, uint32_t sample);

/* Returns a sample offset for the box filter, in pixels from -0.5 to 0.5 (exclusive). Samples
 * follow Roberts' R2 low-discrepancy sequence. Sample 0 is at the pixel centre. */
vec2s pixel_filter_jitter(uint32_t sample);

#endif
