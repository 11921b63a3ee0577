/* ui_pixel_inspector.h: panel of the pixel inspector. */
#ifndef FIRN_VIEW_PANELS_UI_PIXEL_INSPECTOR_H
#define FIRN_VIEW_PANELS_UI_PIXEL_INSPECTOR_H

#include "src/view/panels/ui_internal.h"

/* Draws a drop-down list of the layers; changing the layer resets the channel. If `label` is NULL,
 * draws it as a row of the panel. */
void ui_pixel_inspector_layer_list(const char *label, struct pixel_inspector_choice *choice);

void ui_pixel_inspector_panel(struct ui *ui, const struct ui_view *view,
                              struct ui_request *request);

#endif
