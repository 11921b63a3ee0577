/* ui_overlay.h: technique that draws the user interface over the image, after `present`. Before
 * each frame, the caller sets the draw list rg_frame.overlay and fills the vertex and index
 * buffers. Docked panels are cached as an image, which is copied into each frame. The cached image
 * is redrawn only if window_frame.panels_are_outdated is set. */
#ifndef FIRN_VIEW_WINDOW_UI_OVERLAY_H
#define FIRN_VIEW_WINDOW_UI_OVERLAY_H
#include "src/tech/technique.h"

enum {
    OVERLAY_PANELS,
    OVERLAY_COPY,
    OVERLAY_COMMANDS,
    OVERLAY_PASS_COUNT,
};

/* Pass tables for one window format. The struct points to itself and must not be moved. */
struct overlay_tables {
    struct rg_image panels;
    struct rg_use copy_uses[3];
    struct rg_target targets[OVERLAY_PASS_COUNT];
    struct rg_pass passes[OVERLAY_PASS_COUNT];
    struct rg_technique technique;
};

/* Initialises the tables. `copies` is true if window images support transfer writes. If `copies`,
 * docked panels are cached. Otherwise each frame draws all panels. */
void overlay_tables_init(struct overlay_tables *tables, const struct rg_image *window, bool copies);

extern const struct rg_image overlay_font;      /* font atlas and thumbnails */
extern const struct rg_buffer overlay_vertices; /* struct overlay_vertex */
extern const struct rg_buffer overlay_indices;  /* uint32_t */
extern const struct technique overlay;          /* draws over present_window */

#endif
