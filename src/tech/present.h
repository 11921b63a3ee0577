/*
 * present.h: a picture in a window, texel by texel; or two, side by side.
 *
 * The pictures (tonemap_color and, right of a line, present_right) and the window's image are
 * imported by a plan of their own, apart from that of the frame. The window's format is known at
 * run time only, so its rows are made then.
 */
#ifndef TECH_PRESENT_H
#define TECH_PRESENT_H
#include "src/technique.h"

enum {
    PRESENT_PASS_COUNT = 2,
};

/* Points into itself: must not move. */
struct present_tables {
    struct rg_image window;
    struct rg_target targets[PRESENT_PASS_COUNT];
    struct rg_pass passes[PRESENT_PASS_COUNT];
    struct rg_technique technique;
};

void present_tables_init(struct present_tables *tables, VkFormat format);

extern const struct rg_image present_window; /* the same for the format most windows have */
extern const struct rg_image present_right;  /* as tonemap_color */
extern const struct technique present;

#endif
