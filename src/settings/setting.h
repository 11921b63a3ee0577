/* setting.h: the row of a setting, and groups of them; settings.h has their values. */
#ifndef FIRN_SETTINGS_SETTING_H
#define FIRN_SETTINGS_SETTING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum setting_type {
    SETTING_FLOAT,
    SETTING_COUNT,  /* uint32_t */
    SETTING_SWITCH, /* uint32_t, 0 or 1; "on" and "off" */
    SETTING_CHOICE, /* uint32_t, index into choices */
};

/* What has to be made anew when a setting changes, each with all before it. */
enum setting_effect {
    SETTING_AFFECTS_NOTHING,
    SETTING_AFFECTS_FRAME, /* it is read in every frame */
    SETTING_AFFECTS_PLAN,  /* the plan, or constants that its pipelines are made with */
    SETTING_AFFECTS_SCENE, /* what is loaded or generated */
};

struct setting {
    const char *name; /* "<group>.<parameter>" */
    enum setting_type type;
    size_t offset; /* of the field in the group's struct */
    double initial, min, max;
    bool has_auto;                /* setting_auto() is the word "auto" */
    const char *unit;             /* "degrees"; NULL: none */
    const char *const *choices;   /* ends at NULL */
    const char *help;             /* one line, no full stop */
    enum setting_effect affects;  /* of any change; SETTING_AFFECTS_NOTHING means FRAME */
    enum setting_effect switches; /* of a change from 0 or to it, if that affects more */
};

/* Returns what stands for the word "auto", which is below `min`. */
static inline double setting_auto(const struct setting *row)
{
    return row->type == SETTING_FLOAT ? -1.0 : 0.0;
}

/* Whether a value is the word "auto". */
static inline bool setting_is_auto(const struct setting *row, double value)
{
    return row->has_auto && value < row->min;
}

struct setting_group {
    const char *name;
    const struct setting *rows;
    size_t row_count;
    size_t params_size; /* bytes of the struct */
};

#define SETTING_GROUP(title, table, type) \
    { \
        .name = (title), .rows = (table), .row_count = sizeof(table) / sizeof((table)[0]), \
        .params_size = sizeof(type) \
    }

#endif
