/*
 * present.h: a picture in a window; or two, side by side.
 *
 * It is shown texel by texel, or filtered until one of the window's size has been drawn.
 *
 * The pictures (frame_display and, right of a line, present_right) and the window's image are
 * imported by a plan of their own, apart from that of the frame. The window's format is known at
 * run time only, so its rows are made then.
 */
#ifndef FIRN_VIEW_PRESENT_H
#define FIRN_VIEW_PRESENT_H
#include "shaders/present.h"
#include "src/tech/technique.h"
#include "src/view/layout.h"

struct overlay_list;

/* Where the window shows a picture, pixels from the window's upper left corner. */
struct present_place {
    uint32_t
        line; /* first column of the line, from the picture's left; PRESENT_NO_LINE: one picture */
    uint32_t x, y;                      /* of the shown picture */
    uint32_t width, height;             /* as it is shown */
    uint32_t texel_columns, texel_rows; /* as it was drawn */
    uint32_t surround;                  /* what is around it, 0xRRGGBB, sRGB-encoded */
};

/* What the techniques of a window read: rg_frame.window. */
struct window_frame {
    struct present_place present;
    struct layout layout;
    const struct overlay_list *overlay;    /* src/view/overlay_list.h; NULL: nothing lies over it */
    bool keeps_panels;                     /* what is docked is copied from an image: */
    bool panels_are_old;                   /* which has another list */
    const struct rg_image *panels, *shown; /* that image, and the window's; with keeps_panels */
    uint32_t right_columns, right_rows;    /* of the right picture, texels */
    bool encodes;                          /* the window's format encodes what is written as sRGB */
};

enum {
    PRESENT_PASS_COUNT = 4,
};

/* Points into itself: must not move. */
struct present_tables {
    struct rg_image window;
    struct rg_target targets[PRESENT_PASS_COUNT];
    struct rg_pass passes[PRESENT_PASS_COUNT];
    struct rg_technique technique;
};

/* Shows a picture of a size as large as it fits into a part of the window, which is not empty.
 * `divider`: where it is split, of its width, from the left; below 0: it is not. */
struct present_place present_fit(VkRect2D view, VkExtent2D picture, double divider);

void present_tables_init(struct present_tables *tables, VkFormat format);

extern const struct rg_image present_window; /* the same for the format most windows have */
extern const struct rg_image present_right;  /* as frame_display */
extern const struct technique present;

#endif
