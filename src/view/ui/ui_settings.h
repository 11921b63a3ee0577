/*
 * ui_settings.h: a widget for every row of the settings, by itself.
 *
 * True of what draws: a hand has changed a setting.
 */
#ifndef FIRN_VIEW_UI_UI_SETTINGS_H
#define FIRN_VIEW_UI_UI_SETTINGS_H

#include "src/settings/settings.h"
#include "src/view/ui/ui_groups.h"

enum ui_widget {
    UI_CHECKBOX,
    UI_LIST,
    UI_SLIDER,
    UI_LOGARITHMIC, /* a slider whose small values have more room */
    UI_NUMBER,      /* typed: a range too long for sliding */
};

/* What fits a row. */
enum ui_widget ui_settings_widget(const struct setting *row);

/* What hands change, and what it is reset to: what the scene has by itself. */
struct ui_settings {
    struct settings *now;
    const struct settings *usual;
};

/* A row's name, its widget, its help and, where it is not as usual, a mark and a reset. */
bool ui_settings_row(const struct ui_settings *settings, const struct setting *row);

/* The heading of a group, which opens and closes it, with a reset of all in it. */
bool ui_settings_heading(const struct ui_settings *settings, enum ui_group group, bool *open);

/* The rows of a group; those wanted less only with `more`, which a hand changes. */
bool ui_settings_group(const struct ui_settings *settings, enum ui_group group, bool *more);

/* Whether name, help, group or synonyms hold each of the words, which blanks separate. */
bool ui_settings_fit(const struct setting *row, const char *words);

/* The rows of all groups that words fit. */
bool ui_settings_found(const struct ui_settings *settings, const char *words);

#endif
