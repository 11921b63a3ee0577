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

/* Where an assignment is, for messages. */
struct settings_source {
    const char *path; /* of a file */
    uint32_t line;    /* of a text file, from 1; 0: none */
};

/*
 * The same for an assignment of a file, which is STATUS_DATA if it is wrong. *row is its row, or
 * NULL then. If `source` is NULL, it is the value of --set.
 */
MUST_USE enum status settings_assign(struct settings *settings, const char *assignment,
                                     const struct settings_source *source,
                                     const struct setting **row);

enum {
    SETTINGS_FIELD_COUNT = SETTINGS_SIZE / sizeof(float)
};

/* Returns a number below SETTINGS_FIELD_COUNT that no other row has. */
size_t settings_index(const struct setting *row);

/* The same for a value known to be in range. */
void settings_put(struct settings *settings, const struct setting *row, double value);
double settings_get(const struct settings *settings, const struct setting *row);

/* The most that the changes from `before` to `after` affect. */
enum setting_effect settings_changed(const struct settings *before, const struct settings *after);

/* A row's value as --set takes it: "0.33", "on", "neutral". */
void settings_print(const struct settings *settings, const struct setting *row, FILE *out);

/* Prints a line "NAME=VALUE" for each row whose value is not the default; `before` each name. */
void settings_print_changes(const struct settings *settings, const char *before, FILE *out);

/* A number with as many digits as it takes to get the same float back. */
void settings_print_number(float value, FILE *out);

#endif
