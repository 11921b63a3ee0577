/*
 * settings.h: values of all parameters that a user can set by name, driven by one table.
 *
 * A group is a struct of parameters (often the very struct that a shader reads) with one row per
 * member: name, type, range, default, unit, help. The rows drive --set, the help, `firn list
 * settings` and the metadata of images. Techniques add their own groups.
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
}; /* size of all groups' structs, bytes */

struct settings {
    _Alignas(16) unsigned char values[SETTINGS_SIZE];
};

/* Returns group i, in the order of help and metadata; NULL if i is out of range. */
const struct setting_group *settings_group(size_t i);

struct settings settings_default(void);

/* Returns a pointer to a group's values, to be cast to the group's struct type. */
const void *settings_of(const struct settings *settings, const struct setting_group *group);

/* Returns the setting of a group that describes the struct member at `offset` bytes. */
const struct setting *settings_row(const struct setting_group *group, size_t offset);

/* Returns the setting with a name from user input; NULL if it is unknown. */
const struct setting *settings_find(const char *name);

/*
 * Applies an assignment "name=value". For an unknown name, logs the nearest name. For an invalid
 * value, logs the valid range. Returns STATUS_USAGE in both cases.
 */
MUST_USE enum status settings_set(struct settings *settings, const char *assignment);

/* Source of an assignment, for error messages. */
struct settings_source {
    const char *path; /* path of the file */
    uint32_t line;    /* from 1; 0 if none */
};

/*
 * Applies an assignment from a file, or from the command line if `source` is NULL. Sets *row to the
 * setting. If the assignment is invalid, logs its source, sets *row to NULL, and returns
 * STATUS_DATA (file) or STATUS_USAGE (command line).
 */
MUST_USE enum status settings_assign(struct settings *settings, const char *assignment,
                                     const struct settings_source *source,
                                     const struct setting **row);

enum {
    SETTINGS_FIELD_COUNT = SETTINGS_SIZE / sizeof(float)
};

/* Returns an index below SETTINGS_FIELD_COUNT that is unique to the setting. */
size_t settings_index(const struct setting *row);

/* Sets a setting's value as a number, without a range check; settings_get() returns it. */
void settings_set_value(struct settings *settings, const struct setting *row, double value);
double settings_get(const struct settings *settings, const struct setting *row);

/* Returns the greatest effect of all changes from `before` to `after`. */
enum setting_effect settings_changed(const struct settings *before, const struct settings *after);

/* Prints a setting's value in the syntax of --set, such as "0.33", "on" or "neutral". */
void settings_print(const struct settings *settings, const struct setting *row, FILE *out);

/* Prints a line, `before` and "NAME=VALUE", for each setting that is not at its default. */
void settings_print_changes(const struct settings *settings, const char *before, FILE *out);

/* Prints a number with the fewest digits that parse to the same float. */
void settings_print_number(float value, FILE *out);

#endif
