/* quality.h: quality levels draft, normal and high, each with values of several settings. */
#ifndef FIRN_SETTINGS_QUALITY_H
#define FIRN_SETTINGS_QUALITY_H

#include "src/settings/settings.h"

enum {
    QUALITY_COUNT = 3,
    QUALITY_RENDER_DEFAULT = 2, /* default level of firn render and firn view */
};

struct quality {
    const char *name;
    const char *help;
    uint32_t samples; /* --samples takes precedence */
    bool is_smooth;   /* Blackman-Harris, unless --pixel-filter is given */
};

extern const struct quality qualities[QUALITY_COUNT];

/* A setting whose value depends on the quality level. */
struct quality_row {
    const char *setting;
    const char *values[QUALITY_COUNT]; /* NULL for the setting's default */
};

extern const struct quality_row quality_rows[]; /* terminated by a row of zeros */

/* Returns the value of one setting at a quality level. */
double quality_value(const struct quality_row *row, uint32_t level);

/* Returns true if the setting of a row has the value of one of the quality levels. */
bool quality_is_of_level(const struct settings *settings, const struct quality_row *row);

/* Sets the values of a quality level, with a source (settings_put()). */
void quality_apply(struct settings *settings, uint32_t level, enum setting_source source);

/* Returns the quality level that all settings match; QUALITY_COUNT if there is none. */
uint32_t quality_find(const struct settings *settings);

/* Returns the quality level that most settings match; among equals, the one of default values. */
uint32_t quality_nearest(const struct settings *settings);

#endif
