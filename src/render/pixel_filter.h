/* pixel_filter.h: where the samples of a pixel are. */
#ifndef FIRN_RENDER_PIXEL_FILTER_H
#define FIRN_RENDER_PIXEL_FILTER_H

enum pixel_filter {
    PIXEL_FILTER_BOX,   /* all over the pixel: the mean is that over its area */
    PIXEL_FILTER_POINT, /* all at its centre */
    PIXEL_FILTER_COUNT,
};

#endif
