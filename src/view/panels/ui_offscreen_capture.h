/* ui_offscreen_capture.h: screenshot of the window with its panels. */
#ifndef FIRN_VIEW_PANELS_UI_OFFSCREEN_CAPTURE_H
#define FIRN_VIEW_PANELS_UI_OFFSCREEN_CAPTURE_H

#include "src/view/panels/ui.h"

/* Renders the window's contents with the panels. *rgba has the window's size; the caller frees it.
 * On failure, logs and sets *rgba to NULL. */
MUST_USE enum status ui_screenshot(const struct presenter *presenter,
                                   const struct viewport *viewport,
                                   const struct window_frame *frame, struct ui *ui, uint8_t **rgba);

#endif
