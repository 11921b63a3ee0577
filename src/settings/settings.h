/*
 * settings.h: the parameters a user can set by name, from one table.
 *
 * A group is a struct of parameters (often the very struct a shader reads) and the rows that
 * describe its fields: name, type, range, default, unit, help. The rows drive --set, the help,
 * `firn list settings` and the metadata of pictures. Techniques bring their groups with them.
 *
 * Thread-safety: a struct settings may be read from many threads.
 */
#ifndef FIRN_SETTINGS_SETTINGS_H
#define FIRN_SETTINGS_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include "src/base/status.h"

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
    const char *unit;             /* "degrees"; NULL: none */
    const char *const *choices;   /* ends at NULL */
    const char *help;             /* one line, no full stop */
    enum setting_effect affects;  /* of any change; SETTING_AFFECTS_NOTHING means FRAME */
    enum setting_effect switches; /* of a change from 0 or to it, if that affects more */
};

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

enum {
    SETTINGS_SIZE = 1024
}; /* bytes of all groups' structs; checked by a test */

struct settings {
    _Alignas(16) unsigned char values[SETTINGS_SIZE];
};

/* Group i in the order of help and metadata; NULL: there are no more. */
const struct setting_group *settings_group(size_t i);

struct settings settings_default(void);

/* The struct of a group. */
const void *settings_of(const struct settings *settings, const struct setting_group *group);

/* The row of a group for the field at that offset of its struct. */
const struct setting *settings_row(const struct setting_group *group, size_t offset);

/* Row of that name, or NULL. For names that come from outside. */
const struct setting *settings_find(const char *name);

/*
 * Sets "name=value". An unknown name, a value that is no number or choice, or one out of range is
 * logged (with the nearest name or the range) and is STATUS_USAGE.
 */
MUST_USE enum status settings_set(struct settings *settings, const char *assignment);

/* The same for a value known to be in range. */
void settings_put(struct settings *settings, const struct setting *row, double value);
double settings_get(const struct settings *settings, const struct setting *row);

/* The most that the changes from `before` to `after` affect. */
enum setting_effect settings_changed(const struct settings *before, const struct settings *after);

/* A row's value as --set takes it: "0.33", "on", "neutral". */
void settings_print(const struct settings *settings, const struct setting *row, FILE *out);

/* A number with as many digits as it takes to get the same float back. */
void settings_print_number(float value, FILE *out);

#endif
