/* option_quality.h: levels of quality, each a set of values of settings. */
#ifndef FIRN_APP_OPTIONS_OPTION_QUALITY_H
#define FIRN_APP_OPTIONS_OPTION_QUALITY_H

#include "src/app/options/option.h"

enum {
    QUALITY_COUNT = 3,
};

struct quality {
    const char *name;
    const char *help;
    uint32_t samples; /* of firn render, unless --samples says */
};

extern const struct quality qualities[QUALITY_COUNT];

/* A setting that levels decide. */
struct quality_row {
    const char *setting;
    const char *values[QUALITY_COUNT]; /* by level; NULL: the setting's default */
};

extern const struct quality_row quality_rows[]; /* ends at a row of zeros */

/* --quality, of struct app_picture: --set and --preset win. */
option_fn option_quality;

#endif
