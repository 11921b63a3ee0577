/*
 * settings.h: values of all parameters that can be set by name, each with its source.
 *
 * A group is a struct of parameters (often the very struct that a shader reads) with one table row
 * per member: name, type, range, default, unit, help. The rows drive --set, the help, `firn list
 * settings` and the metadata of images. Techniques add their own groups (root meson.build).
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

/* Source of a setting's value, weakest first. A value never replaces one of a stronger source. */
enum setting_source {
    SETTING_DEFAULT, /* default of the table */
    SETTING_SCENE,   /* built-in scene, bundled asset or model file */
    SETTING_QUALITY, /* quality level */
    SETTING_PRESET,  /* preset file, or the preset of a material */
    SETTING_USER,    /* --set and other options, or the window */
};

enum {
    SETTINGS_FIELD_COUNT = SETTING_GROUP_COUNT * (SETTING_GROUP_SIZE / sizeof(float))
};

struct settings {
    _Alignas(16) unsigned char values[SETTING_GROUP_COUNT][SETTING_GROUP_SIZE];
    unsigned char sources[SETTINGS_FIELD_COUNT]; /* enum setting_source */
};

/* All groups, in the order of help and metadata; ends at NULL. */
extern const struct setting_group *const setting_groups[];

struct settings settings_default(void);

/* Returns true if all values are equal. Sources are not compared. */
bool settings_equal(const struct settings *a, const struct settings *b);

/* Returns a pointer to the values of a group, to be cast to its struct type. */
static inline const void *settings_of(const struct settings *settings,
                                      const struct setting_group *group)
{
    return settings->values[group->index];
}

/* Returns the setting after `row`, ordered by group, or NULL after the last setting. If `row` is
 * NULL, returns the first setting. */
const struct setting *settings_next(const struct setting *row);

/* Returns the setting of a group that describes the struct member at `offset` bytes. */
const struct setting *settings_row(const struct setting_group *group, size_t offset);

/* Returns the setting with a name from user input; NULL if it is unknown. */
const struct setting *settings_find(const char *name);

/* Place of an assignment in a file, for error messages. */
struct settings_location {
    const char *path; /* path of the file */
    uint32_t line;    /* from 1; 0 if none */
};

/*
 * Applies an assignment "name=value" from a file, or from the command line if `location` is NULL.
 * Passes the value and `source` to settings_put(). If the name is unknown or the value is invalid,
 * logs an error and returns STATUS_DATA (file) or STATUS_USAGE (command line).
 */
MUST_USE enum status settings_assign(struct settings *settings, const char *assignment,
                                     enum setting_source source,
                                     const struct settings_location *location);

/* Sets a value and its source, and returns true. If the present value has a stronger source,
 * changes nothing and returns false. Does not check the range. */
bool settings_put(struct settings *settings, const struct setting *row, double value,
                  enum setting_source source);

/* Sets a value regardless of its source, which is kept. Does not check the range. */
void settings_set_value(struct settings *settings, const struct setting *row, double value);

/* Gives all values the same source. */
void settings_set_sources(struct settings *settings, enum setting_source source);

/* Copies one value and its source. */
void settings_copy(struct settings *to, const struct setting *row, const struct settings *from);

double settings_get(const struct settings *settings, const struct setting *row);
enum setting_source settings_source(const struct settings *settings, const struct setting *row);

/* Returns the greatest effect of all changes from `before` to `after`. */
enum setting_effect settings_changed(const struct settings *before, const struct settings *after);

/* Prints a setting's value in the syntax of --set, such as "0.33", "on" or "neutral". */
void settings_print(const struct settings *settings, const struct setting *row, FILE *out);

/* Prints a line, `before` and "NAME=VALUE", for each setting that is not at its default. */
void settings_print_changes(const struct settings *settings, const char *before, FILE *out);

/* Prints a number with the fewest digits that parse to the same float. */
void settings_print_number(float value, FILE *out);

#endif
