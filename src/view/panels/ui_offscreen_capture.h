/* ui_offscreen_capture.h: screenshot of the window with its panels. */
#ifndef FIRN_VIEW_PANELS_UI_OFFSCREEN_CAPTURE_H
#define FIRN_VIEW_PANELS_UI_OFFSCREEN_CAPTURE_H

#include "src/view/panels/ui.h"

/* Renders the window's contents with the panels to *rgba, which has the size of the window. The
 * caller frees *rgba. On failure, logs an error and sets *rgba to NULL. */
MUST_USE enum status ui_screenshot(const struct presenter *presenter,
                                   const struct viewport *viewport,
                                   const struct window_frame *frame, struct ui *ui, uint8_t **rgba);

#endif
