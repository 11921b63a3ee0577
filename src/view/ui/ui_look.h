/* ui_look.h: the panel of layers and values. */
#ifndef FIRN_VIEW_UI_UI_LOOK_H
#define FIRN_VIEW_UI_UI_LOOK_H

#include "src/view/ui/ui_internal.h"

void ui_look_panel(struct ui *ui, const struct ui_view *view, struct ui_wish *wish);

#endif
