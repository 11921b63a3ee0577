/* ui_look.h: panel of the pixel inspector. */
#ifndef FIRN_VIEW_UI_UI_LOOK_H
#define FIRN_VIEW_UI_UI_LOOK_H

#include "src/view/ui/ui_internal.h"

/* Draws a drop-down list of the layers; changing the layer resets the channel. */
void ui_look_list(const char *label, struct look_choice *choice);

void ui_look_panel(struct ui *ui, const struct ui_view *view, struct ui_wish *wish);

#endif
