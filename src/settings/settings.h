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
#include "src/settings/setting.h"

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

/* Rows that somebody has chosen the values of: a bit for each. */
struct settings_rows {
    uint64_t bits[SETTINGS_SIZE / sizeof(float) / 64];
};

void settings_rows_add(struct settings_rows *rows, const struct setting *row);
bool settings_rows_have(const struct settings_rows *rows, const struct setting *row);

/* Adds the row of "name=value", if there is one. */
void settings_rows_add_assigned(struct settings_rows *rows, const char *assignment);

/* A row's value as --set takes it: "0.33", "on", "neutral". */
void settings_print(const struct settings *settings, const struct setting *row, FILE *out);

/* A number with as many digits as it takes to get the same float back. */
void settings_print_number(float value, FILE *out);

#endif
