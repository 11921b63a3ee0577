/* ui_screenshot.h: screenshot of the window with its panels. */
#ifndef FIRN_VIEW_UI_UI_SCREENSHOT_H
#define FIRN_VIEW_UI_UI_SCREENSHOT_H

#include "src/view/ui/ui.h"

/* Renders the window's contents with the panels. The caller frees *rgba, which has the window's
 * size; it is NULL on failure, which is logged. */
MUST_USE enum status ui_screenshot(const struct presenter *presenter,
                                   const struct viewport *viewport,
                                   const struct window_frame *frame, struct ui *ui, uint8_t **rgba);

#endif
