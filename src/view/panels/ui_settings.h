/* ui_settings.h: settings panel with a widget for every setting. All drawing functions return true
 * if the user has changed a setting. */
#ifndef FIRN_VIEW_PANELS_UI_SETTINGS_H
#define FIRN_VIEW_PANELS_UI_SETTINGS_H

#include "src/scene/scene.h"
#include "src/settings/settings.h"
#include "src/view/panels/ui_setting_groups.h"

enum ui_widget {
    UI_CHECKBOX,
    UI_LIST,
    UI_SLIDER,
    UI_LOGARITHMIC,
    UI_NUMBER, /* number field for long ranges */
};

/* Returns the kind of widget for a setting. */
enum ui_widget ui_settings_widget(const struct setting *row);

/* Settings edited by the user, and the scene's original settings for the reset buttons. */
struct ui_settings {
    struct settings *current;
    const struct settings *defaults;
    const struct scene *scene;
};

/* Returns why a setting has no effect in a scene, as a sentence; NULL if it has one, or may. */
const char *ui_setting_no_effect(const struct setting *row, const struct settings *settings,
                                 const struct scene *scene);

/* Draws a setting: label, widget, tooltip and, if it was changed, a mark and a reset button. */
bool ui_settings_row(const struct ui_settings *settings, const struct setting *row);

/* Draws the collapsible heading of a group, with a button that resets the group. */
bool ui_settings_heading(const struct ui_settings *settings, enum ui_setting_group group,
                         bool *open);

/* Draws a group's settings, including less useful ones if *more is true. A button toggles *more. */
bool ui_settings_group(const struct ui_settings *settings, enum ui_setting_group group, bool *more);

/* Returns true if each word of `query` occurs in one of the texts, ignoring case. If `at_start`,
 * words of the texts must begin with them. */
bool ui_settings_contain(const char *const *texts, size_t count, const char *query, bool at_start);

/* Returns true if each word of `query` occurs in the setting's name, label, help or group. */
bool ui_settings_match(const struct setting *row, const char *query);

/* Draws the settings of all groups that match `query`. */
bool ui_settings_matches(const struct ui_settings *settings, const char *query);

#endif
