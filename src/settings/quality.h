/* quality.h: levels of quality, each a set of values of settings. */
#ifndef FIRN_SETTINGS_QUALITY_H
#define FIRN_SETTINGS_QUALITY_H

#include "src/settings/settings.h"

enum {
    QUALITY_COUNT = 3,
    QUALITY_OF_FILES = 2, /* the level of firn render that says nothing of it */
};

struct quality {
    const char *name;
    const char *help;
    uint32_t samples; /* of firn render, unless --samples says */
    bool is_smooth;   /* firn render's filter is blackman-harris, unless --pixel-filter says */
};

extern const struct quality qualities[QUALITY_COUNT];

/* A setting that levels decide. */
struct quality_row {
    const char *setting;
    const char *values[QUALITY_COUNT]; /* by level; NULL: the setting's default */
};

extern const struct quality_row quality_rows[]; /* ends at a row of zeros */

/* Puts a level's value of a row's setting. */
void quality_put(struct settings *settings, const struct quality_row *row, uint32_t level);

/* Returns the level that the settings of all rows are at, or QUALITY_COUNT. */
uint32_t quality_of(const struct settings *settings);

#endif
