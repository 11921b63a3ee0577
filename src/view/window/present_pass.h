/* present_pass.h: technique that draws one image, or two side by side, into the swapchain image.
 * The image is copied 1:1, or filtered until one of the window's size has been drawn. The window's
 * own plan imports the source images (frame_display and, right of the divider, present_right) and
 * the swapchain image. Its tables are built at run time, when the swapchain's format is known. */
#ifndef FIRN_VIEW_WINDOW_PRESENT_PASS_H
#define FIRN_VIEW_WINDOW_PRESENT_PASS_H
#include "shaders/output/present.h"
#include "src/tech/technique.h"
#include "src/view/window/window_layout.h"

struct overlay_draw_list;

/* Rectangle of the image in the window, pixels from the upper left corner. */
struct present_area {
    uint32_t line;                      /* divider column, or PRESENT_NO_LINE */
    uint32_t x, y;                      /* upper left corner of the image */
    uint32_t width, height;             /* displayed size */
    uint32_t texel_columns, texel_rows; /* size of the source image, texels */
    uint32_t surround;                  /* colour of the margins, 0xRRGGBB, sRGB-encoded */
};

/* Per-frame data of the techniques that draw the window, passed as rg_frame.window. */
struct window_frame {
    struct present_area present;
    struct window_layout layout;
    const struct overlay_draw_list *overlay;      /* NULL without user interface */
    bool caches_panels;                           /* docked panels are cached */
    bool panels_are_outdated;                     /* cached panels must be redrawn */
    const struct rg_image *panels, *window_image; /* used only with caches_panels */
    uint32_t right_columns, right_rows;           /* size of the right image, texels */
    bool encodes_srgb;                            /* window format encodes sRGB on write */
};

enum {
    PRESENT_PASS_COUNT = 4,
};

/* Pass tables for one window format. The struct points to itself and must not be moved. */
struct present_tables {
    struct rg_image window;
    struct rg_target targets[PRESENT_PASS_COUNT];
    struct rg_pass passes[PRESENT_PASS_COUNT];
    struct rg_technique technique;
};

/* Fits an image of size `image` into the non-empty rectangle `view`. Keeps the aspect ratio.
 * `divider` is a fraction of the image width; negative without a split view. */
struct present_area present_fit(VkRect2D view, VkExtent2D image, double divider);

void present_tables_init(struct present_tables *tables, VkFormat format);

extern const struct rg_image present_window; /* with the most common window format */
extern const struct rg_image present_right;  /* like frame_display */
extern const struct technique present;

#endif
