/*
 * settings.h: the parameters a user can set by name, from one table.
 *
 * A group is a struct of parameters (often the very struct a shader reads) and the rows that
 * describe its fields: name, type, range, default, unit, help. The rows drive --set, the help,
 * `firn list settings` and the metadata of pictures. settings.c lists the groups.
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

struct setting {
    const char *name; /* "<group>.<parameter>" */
    enum setting_type type;
    size_t offset; /* of the field in the group's struct */
    double initial, min, max;
    const char *unit;           /* "degrees"; NULL: none */
    const char *const *choices; /* ends at NULL */
    const char *help;           /* one line, no full stop */
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

/* All groups, in the order of help and metadata; ends at NULL. */
extern const struct setting_group *const setting_groups[];

struct settings settings_default(void);

/* The struct of a group. */
const void *settings_of(const struct settings *settings, const struct setting_group *group);

/* Row of that name, or NULL. */
const struct setting *settings_find(const char *name);

/*
 * Sets "name=value". An unknown name, a value that is no number or choice, or one out of range is
 * logged (with the nearest name or the range) and is STATUS_USAGE.
 */
MUST_USE enum status settings_set(struct settings *settings, const char *assignment);

/* The same for a value known to be in range. */
void settings_put(struct settings *settings, const struct setting *row, double value);
double settings_get(const struct settings *settings, const struct setting *row);

/* A row's value as --set takes it: "0.33", "on", "neutral". */
void settings_print(const struct settings *settings, const struct setting *row, FILE *out);

/* A number with as many digits as it takes to get the same float back. */
void settings_print_number(float value, FILE *out);

#endif
