/*
 * window_layout.h: layout of the window: image area and docked panels. They never overlap.
 *
 *     +---------------------+-------+
 *     | bar                 |       |
 *     +---------------------+ panel |
 *     | image               |       |
 *     +---------------------+       |
 *     | strip               |       |
 *     +---------------------+-------+
 *     | status                      |
 *     +-----------------------------+
 */
#ifndef FIRN_VIEW_WINDOW_WINDOW_LAYOUT_H
#define FIRN_VIEW_WINDOW_WINDOW_LAYOUT_H

#include <stdbool.h>
#include <volk.h>

/* Rectangles in pixels. A panel is 0x0 if it is hidden or the window is too small for it. */
struct window_layout {
    VkRect2D image; /* rendered image, at least 1x1 */
    VkRect2D bar, panel, status;
    VkRect2D strip; /* timeline; 0x0 in low windows */
};

/* Computes the layout of a window of at least 1x1 pixels. `scale` multiplies panel sizes. */
struct window_layout window_layout_of(VkExtent2D window, float scale, bool has_panels);

/* Returns the window size, in pixels, at which the image area has the size `image`. */
VkExtent2D window_layout_for_image(VkExtent2D image, float scale);

#endif
