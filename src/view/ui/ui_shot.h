/*
 * ui_shot.h: the picture with its panels, as a window shows it, for a file.
 */
#ifndef FIRN_VIEW_UI_UI_SHOT_H
#define FIRN_VIEW_UI_UI_SHOT_H

#include "src/view/ui/ui.h"

/* *rgba: malloc'd, of the screen's size; the caller frees it. The picture is what the screen shows.
 * Logs; *rgba is then NULL. */
MUST_USE enum status ui_shot(const struct screen *screen, const struct picture *picture,
                             const struct window_frame *shown, struct ui *ui, uint8_t **rgba);

#endif
