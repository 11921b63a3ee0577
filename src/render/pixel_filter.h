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

/* Returns a sample's offset from the pixel centre, in pixels to the right and down. Sample 0 is at
 * the centre. All samples have equal weight, because their density follows the filter (filter
 * importance sampling; Ernst, Stamminger and Greiner 2006). */
vec2s pixel_filter_offset(enum pixel_filter filter, uint32_t sample);

/* Returns a sample offset for the box filter, from -0.5 to 0.5 pixels (exclusive). Sample 0 is at
 * the pixel centre. The samples follow Roberts' R2 low-discrepancy sequence. */
vec2s pixel_filter_jitter(uint32_t sample);

#endif
