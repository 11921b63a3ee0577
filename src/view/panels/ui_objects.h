/* ui_objects.h: list of the scene's objects, and rows of the selected one. */
#ifndef FIRN_VIEW_PANELS_UI_OBJECTS_H
#define FIRN_VIEW_PANELS_UI_OBJECTS_H

#include "src/view/panels/ui_internal.h"

/* Returns the selected object; NULL if there is none. */
const struct scene_object *ui_objects_selected(const struct ui_view *view);

/* Draws the list of objects, facts about the file, and position, rotation and scale of the selected
 * object. */
void ui_objects_rows(struct ui *ui, const struct ui_view *view, struct ui_request *request);

/* Returns true if a material that is chosen now is for the selected object alone. */
bool ui_objects_have_own_material(const struct ui_view *view);

/* Returns why the selected object cannot be given a material; NULL if it can. */
const char *ui_objects_why_no_material(const struct ui_view *view);

/* Returns the override of the selected object's material; NULL if there is none. */
const struct material_override *ui_objects_override(const struct ui_view *view);

/* Requests a material for the selected object. */
void ui_objects_choose_material(const struct ui_view *view, struct ui_request *request,
                                const struct material_choice *choice);

/* Draws index, roughness and dispersion of the selected object's chosen material. */
void ui_objects_material_rows(struct ui *ui, const struct ui_view *view,
                              struct ui_request *request);

/* Draws the outline of the selected object over the image. */
void ui_objects_outline(struct ui *ui, const struct ui_view *view);

#endif
