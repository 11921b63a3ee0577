/*
 * layout.h: where the picture and the panels are in a window. They never cover each other.
 *
 *     +---------------------+-------+
 *     | bar                 |       |
 *     +---------------------+ panel |
 *     | picture             |       |
 *     +---------------------+       |
 *     | strip               |       |
 *     +---------------------+-------+
 *     | status                      |
 *     +-----------------------------+
 */
#ifndef FIRN_VIEW_LAYOUT_H
#define FIRN_VIEW_LAYOUT_H

#include <stdbool.h>
#include <volk.h>

/* Pixels; extents of panels are 0x0 where they are hidden or the window is too small for them. */
struct layout {
    VkRect2D picture; /* at least 1x1 */
    VkRect2D bar, panel, status;
    VkRect2D strip; /* of time; low windows have none */
};

/* `window` is at least 1x1 pixels, `scale` multiplies the sizes of panels. */
struct layout layout_of(VkExtent2D window, float scale, bool has_panels);

/* The window in which the picture has this size, pixels. */
VkExtent2D layout_around(VkExtent2D picture, float scale);

#endif
