/*
 * ui_settings.h: a widget for every row of the settings, by itself.
 */
#ifndef FIRN_VIEW_UI_UI_SETTINGS_H
#define FIRN_VIEW_UI_UI_SETTINGS_H

#include "src/settings/settings.h"

enum ui_widget {
    UI_CHECKBOX,
    UI_LIST,
    UI_SLIDER,
    UI_LOGARITHMIC, /* a slider whose small values have more room */
    UI_NUMBER,      /* typed: a range too long for sliding */
};

/* What fits a row. */
enum ui_widget ui_settings_widget(const struct setting *row);

/* A row's widget, its help, and a button that puts it back. True: a hand has changed it. */
bool ui_settings_row(struct settings *settings, const struct setting *row, const char *label);

/* Rows whose names hold `filter` ("": all), group by group. True: a hand has changed some. */
bool ui_settings_panel(struct settings *settings, const char *filter);

#endif
