/* ui_busy_box.h: spinner with a line of text, drawn on the CPU while another thread uses the
 * device. */
#ifndef FIRN_VIEW_PANELS_UI_BUSY_BOX_H
#define FIRN_VIEW_PANELS_UI_BUSY_BOX_H

#include <stdint.h>
#include "src/view/panels/ui.h"

struct ui_busy_box {
    uint32_t *pixels; /* 0xRRGGBB, top row first, malloc'd; NULL when out of memory */
    uint32_t width, height;
};

/* Draws the box. `seconds` is the time since the job started, which rotates the spinner. */
struct ui_busy_box ui_busy_box_draw(const struct ui *ui, const char *text, double seconds);

#endif
