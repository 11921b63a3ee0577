/*
 * overlay.h: panels over the picture in a window.
 *
 * Drawn after `present`, to the same image. The triangles and the font's image come from outside:
 * rg_frame.overlay, and the buffers below, filled before each frame. What is docked is drawn only
 * when it is another list (window_frame.panels_are_old), into an image that is copied into each
 * frame: that takes a tenth of the time.
 */
#ifndef FIRN_VIEW_OVERLAY_H
#define FIRN_VIEW_OVERLAY_H
#include "src/tech/technique.h"

enum {
    OVERLAY_PANELS,
    OVERLAY_COPY,
    OVERLAY_PARTS,
    OVERLAY_PASS_COUNT,
};

/* Rows for a window of any format. Points into itself: must not move. */
struct overlay_tables {
    struct rg_image panels;
    struct rg_use copy_uses[3];
    struct rg_target targets[OVERLAY_PASS_COUNT];
    struct rg_pass passes[OVERLAY_PASS_COUNT];
    struct rg_technique technique;
};

/* copies: images can be copied into the window's; else all is drawn in each frame. */
void overlay_tables_init(struct overlay_tables *tables, const struct rg_image *window, bool copies);

extern const struct rg_image overlay_font;      /* letters (white, A: how much is covered) and
                                              pictures, sRGB-encoded; imported */
extern const struct rg_buffer overlay_vertices; /* struct overlay_vertex */
extern const struct rg_buffer overlay_indices;  /* uint32_t */
extern const struct technique overlay;          /* over present_window */

#endif
