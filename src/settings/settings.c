/* settings.c: reads, writes, parses and prints the values of settings by name. */
#include "src/settings/settings.h"
#include <assert.h>
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/suggest.h"

static const struct setting_group *group_of(const struct setting *row)
{
    size_t i = 0;
    while (row < setting_groups[i]->rows ||
           row >= setting_groups[i]->rows + setting_groups[i]->row_count) {
        i++;
        assert(setting_groups[i]); /* the row is in a listed group */
    }
    return setting_groups[i];
}

const struct setting *settings_next(const struct setting *row)
{
    if (!row)
        return setting_groups[0]->rows;
    const struct setting_group *group = group_of(row);
    if (row + 1 < group->rows + group->row_count)
        return row + 1;
    group = setting_groups[group->index + 1];
    return group ? group->rows : NULL;
}

/* Returns the index of a setting's source. */
static size_t field_index(const struct setting *row)
{
    return (group_of(row)->index * SETTING_GROUP_SIZE + row->offset) / sizeof(float);
}

static unsigned char *field_of(struct settings *settings, const struct setting *row)
{
    return &settings->values[group_of(row)->index][row->offset];
}

const struct setting *settings_row(const struct setting_group *group, size_t offset)
{
    size_t i = 0;
    while (i < group->row_count && group->rows[i].offset != offset)
        i++;
    assert(i < group->row_count); /* every member has a row */
    return &group->rows[i];
}

static void write_field(unsigned char *field, const struct setting *row, double value)
{
    if (row->type == SETTING_FLOAT)
        memcpy(field, &(float){ (float)value }, sizeof(float));
    else
        memcpy(field, &(uint32_t){ (uint32_t)value }, sizeof(uint32_t));
}

static double read_field(const unsigned char *field, const struct setting *row)
{
    float number;
    uint32_t count;
    if (row->type == SETTING_FLOAT) {
        memcpy(&number, field, sizeof(number));
        return (double)number;
    }
    memcpy(&count, field, sizeof(count));
    return count;
}

void settings_set_value(struct settings *settings, const struct setting *row, double value)
{
    write_field(field_of(settings, row), row, value);
}

bool settings_put(struct settings *settings, const struct setting *row, double value,
                  enum setting_source source)
{
    if (settings_source(settings, row) > source)
        return false;
    settings_set_value(settings, row, value);
    settings->sources[field_index(row)] = (unsigned char)source;
    return true;
}

void settings_set_sources(struct settings *settings, enum setting_source source)
{
    memset(settings->sources, (int)source, sizeof(settings->sources));
}

void settings_copy(struct settings *to, const struct setting *row, const struct settings *from)
{
    settings_set_value(to, row, settings_get(from, row));
    to->sources[field_index(row)] = from->sources[field_index(row)];
}

double settings_get(const struct settings *settings, const struct setting *row)
{
    return read_field(&settings->values[group_of(row)->index][row->offset], row);
}

enum setting_source settings_source(const struct settings *settings, const struct setting *row)
{
    return (enum setting_source)settings->sources[field_index(row)];
}

bool settings_equal(const struct settings *a, const struct settings *b)
{
    return !memcmp(a->values, b->values, sizeof(a->values));
}

enum setting_effect settings_changed(const struct settings *before, const struct settings *after)
{
    enum setting_effect greatest = SETTING_AFFECTS_NOTHING;
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double a = settings_get(before, row), b = settings_get(after, row);
        if (!(a < b) && !(a > b))
            continue;
        greatest = greatest > SETTING_AFFECTS_FRAME ? greatest : SETTING_AFFECTS_FRAME;
        greatest = greatest > row->affects ? greatest : row->affects;
        if (!(a > 0.0 || a < 0.0) != !(b > 0.0 || b < 0.0))
            greatest = greatest > row->switches ? greatest : row->switches;
    }
    return greatest;
}

struct settings settings_default(void)
{
    struct settings settings = { 0 };
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row))
        settings_set_value(&settings, row, row->initial);
    return settings;
}

const struct setting *settings_find(const char *name)
{
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        if (!strcmp(row->name, name))
            return row;
    }
    return NULL;
}

enum {
    NAME_SIZE = 64,
    LOCATION_SIZE = 512, /* text size of an assignment's location */
};

struct assignment {
    struct settings *settings;
    const struct setting *row;
    enum setting_source source;
    const struct settings_location *location; /* NULL for --set */
};

/* Writes an assignment's location: "--set NAME", "FILE:LINE: NAME" or "FILE: NAME". */
static const char *format_location(const struct settings_location *location, const char *name,
                                   char text[static LOCATION_SIZE])
{
    if (!location)
        snprintf(text, LOCATION_SIZE, "--set%s%s", name[0] ? " " : "", name);
    else if (location->line)
        snprintf(text, LOCATION_SIZE, "%s:%u%s%s", location->path, location->line,
                 name[0] ? ": " : "", name);
    else
        snprintf(text, LOCATION_SIZE, "%s%s%s", location->path, name[0] ? ": " : "", name);
    return text;
}

/* Finds a setting by its former name, and logs its new name. Returns NULL if there is none. */
static const struct setting *find_renamed(const struct settings_location *location,
                                          const char *name)
{
    char where[LOCATION_SIZE];
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        if (row->renamed_from && !strcmp(row->renamed_from, name)) {
            log_note("%s is now named %s", format_location(location, name, where), row->name);
            return row;
        }
    }
    return NULL;
}

static enum status rejection_status(const struct settings_location *location)
{
    return location ? STATUS_DATA : STATUS_USAGE;
}

static enum status reject_name(const struct settings_location *location, const char *name)
{
    struct suggest suggest = { .word = name };
    char hint[SUGGEST_HINT_SIZE], where[LOCATION_SIZE];
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row))
        suggest_offer(&suggest, row->name);
    log_error("%s: unknown setting '%s'%s (firn list settings)",
              format_location(location, "", where), name, suggest_hint(&suggest, hint));
    return rejection_status(location);
}

static enum status reject_value(const struct assignment *a, const char *value)
{
    const struct setting *row = a->row;
    char choices[256] = "", where[LOCATION_SIZE];
    size_t used = 0;
    for (size_t i = 0; row->choices && row->choices[i] && used < sizeof(choices); i++)
        used += (size_t)snprintf(&choices[used], sizeof(choices) - used, "%s%s", i ? ", " : "",
                                 row->choices[i]);
    format_location(a->location, row->name, where);
    if (row->type == SETTING_CHOICE)
        log_error("%s: expected one of %s, got '%s'", where, choices, value);
    else if (row->type == SETTING_SWITCH)
        log_error("%s: expected on or off, got '%s'", where, value);
    else
        log_error(
            "%s: expected %sa %s from %g to %g, got '%s'", where, row->has_auto ? "auto or " : "",
            row->type == SETTING_COUNT ? "whole number" : "number", row->min, row->max, value);
    return rejection_status(a->location);
}

static enum status set_number(const struct assignment *a, const char *text)
{
    const struct setting *row = a->row;
    char *end;
    double value = strtod(text, &end);
    if (row->has_auto && !strcmp(text, "auto")) {
        settings_put(a->settings, row, setting_auto(row), a->source);
        return STATUS_OK;
    }
    if (end == text || *end || isspace((unsigned char)*text) || !isfinite(value) ||
        value < row->min || value > row->max)
        return reject_value(a, text);
    if (row->type == SETTING_COUNT && floor(value) < value)
        return reject_value(a, text);
    settings_put(a->settings, row, value, a->source);
    return STATUS_OK;
}

static enum status set_choice(const struct assignment *a, const char *text)
{
    static const char *const switches[] = { "off", "on", NULL };
    const char *const *names = a->row->type == SETTING_SWITCH ? switches : a->row->choices;
    for (uint32_t i = 0; names[i]; i++) {
        if (!strcmp(names[i], text)) {
            settings_put(a->settings, a->row, i, a->source);
            return STATUS_OK;
        }
    }
    return reject_value(a, text);
}

enum status settings_assign(struct settings *settings, const char *assignment,
                            enum setting_source source, const struct settings_location *location)
{
    const char *equals = strchr(assignment, '=');
    size_t length = equals ? (size_t)(equals - assignment) : 0;
    char name[NAME_SIZE] = "", where[LOCATION_SIZE];
    if (!equals || !length) {
        log_error("%s: expected NAME=VALUE, got '%s'", format_location(location, "", where),
                  assignment);
        return rejection_status(location);
    }
    memcpy(name, assignment, length < NAME_SIZE ? length : NAME_SIZE - 1);
    struct assignment a = { settings, settings_find(name), source, location };
    if (!a.row)
        a.row = find_renamed(location, name);
    if (!a.row || length >= NAME_SIZE)
        return reject_name(location, name);
    const bool is_number = a.row->type == SETTING_FLOAT || a.row->type == SETTING_COUNT;
    return is_number ? set_number(&a, equals + 1) : set_choice(&a, equals + 1);
}

/* Tries 6 to 9 significant digits; 9 are enough for any float. */
void settings_print_number(float value, FILE *out)
{
    char text[32];
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, sizeof(text), "%.*g", digits, (double)value);
        if ((float)strtod(text, NULL) == value)
            break;
    }
    fputs(text, out);
}

void settings_print(const struct settings *settings, const struct setting *row, FILE *out)
{
    double value = settings_get(settings, row);
    if (row->type == SETTING_SWITCH)
        fputs(value > 0.0 ? "on" : "off", out);
    else if (row->type == SETTING_CHOICE)
        fputs(row->choices[(size_t)value], out);
    else if (setting_is_auto(row, value))
        fputs("auto", out);
    else if (row->type == SETTING_COUNT)
        fprintf(out, "%.0f", value);
    else
        settings_print_number((float)value, out);
}

void settings_print_changes(const struct settings *settings, const char *before, FILE *out)
{
    const struct settings defaults = settings_default();
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double a = settings_get(settings, row), b = settings_get(&defaults, row);
        if (!(a < b || a > b))
            continue;
        fprintf(out, "%s%s=", before, row->name);
        settings_print(settings, row, out);
        fputc('\n', out);
    }
}
