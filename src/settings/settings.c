/* settings.c: list of all setting groups; reads, writes, parses and prints values by name. */
#include "src/settings/settings.h"
#include <assert.h>
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/suggest.h"
#include "src/settings/scene_settings.h"
#include "src/tech/techniques.h"

/* Setting groups of the scene; those of the rendering techniques follow them. */
static const struct setting_group *const scene_groups[] = {
    &object_settings,   &ice_settings,     &landscape_settings, &sky_settings,
    &env_settings,      &texture_settings, &motion_settings,    &light_settings,
    &env_cube_settings, &ground_settings,  &lens_settings,      &inclusion_target_settings,
};

enum {
    SCENE_GROUP_COUNT = sizeof(scene_groups) / sizeof(scene_groups[0])
};

/* Iterator over all setting groups, first the scene's, then those of each technique. */
struct iterator {
    const struct setting_group *group; /* NULL at the end */
    size_t offset;                     /* byte offset, a multiple of 16 */
    const struct technique *const *technique;
    size_t index; /* within scene_groups or the technique's groups */
};

static struct iterator first_group(void)
{
    return (struct iterator){ .group = scene_groups[0] };
}

static void next_group(struct iterator *iterator)
{
    iterator->offset += (iterator->group->params_size + 15) / 16 * 16;
    iterator->group = NULL;
    iterator->index++;
    if (!iterator->technique && iterator->index < SCENE_GROUP_COUNT)
        iterator->group = scene_groups[iterator->index];
    if (!iterator->technique && iterator->index == SCENE_GROUP_COUNT) {
        iterator->technique = techniques;
        iterator->index = 0;
    }
    while (!iterator->group && iterator->technique && *iterator->technique) {
        if (iterator->index < TECHNIQUE_GROUP_COUNT)
            iterator->group = (*iterator->technique)->settings[iterator->index];
        if (!iterator->group) {
            iterator->technique++;
            iterator->index = 0;
        }
    }
}

const struct setting_group *settings_group(size_t i)
{
    struct iterator iterator = first_group();
    while (iterator.group && i-- > 0)
        next_group(&iterator);
    return iterator.group;
}

static size_t group_offset(const struct setting_group *group)
{
    struct iterator iterator = first_group();
    while (iterator.group != group) {
        next_group(&iterator);
        assert(iterator.group);
    }
    assert(iterator.offset + group->params_size <= SETTINGS_SIZE);
    return iterator.offset;
}

const void *settings_of(const struct settings *settings, const struct setting_group *group)
{
    return &settings->values[group_offset(group)];
}

static size_t row_offset(const struct setting *row)
{
    for (struct iterator iterator = first_group(); iterator.group; next_group(&iterator)) {
        if (row >= iterator.group->rows && row < iterator.group->rows + iterator.group->row_count)
            return iterator.offset + row->offset;
    }
    assert(false && "the row is in a listed group");
    return 0;
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
    write_field(&settings->values[row_offset(row)], row, value);
}

double settings_get(const struct settings *settings, const struct setting *row)
{
    return read_field(&settings->values[row_offset(row)], row);
}

enum setting_effect settings_changed(const struct settings *before, const struct settings *after)
{
    enum setting_effect greatest = SETTING_AFFECTS_NOTHING;
    for (struct iterator iterator = first_group(); iterator.group; next_group(&iterator)) {
        for (size_t r = 0; r < iterator.group->row_count; r++) {
            const struct setting *row = &iterator.group->rows[r];
            const size_t field = iterator.offset + row->offset;
            const double a = read_field(&before->values[field], row);
            const double b = read_field(&after->values[field], row);
            if (!(a < b) && !(a > b))
                continue;
            greatest = greatest > SETTING_AFFECTS_FRAME ? greatest : SETTING_AFFECTS_FRAME;
            greatest = greatest > row->affects ? greatest : row->affects;
            if (!(a > 0.0 || a < 0.0) != !(b > 0.0 || b < 0.0))
                greatest = greatest > row->switches ? greatest : row->switches;
        }
    }
    return greatest;
}

struct settings settings_default(void)
{
    struct settings settings = { 0 };
    for (struct iterator iterator = first_group(); iterator.group; next_group(&iterator)) {
        for (size_t r = 0; r < iterator.group->row_count; r++)
            write_field(&settings.values[iterator.offset + iterator.group->rows[r].offset],
                        &iterator.group->rows[r], iterator.group->rows[r].initial);
    }
    return settings;
}

const struct setting *settings_find(const char *name)
{
    for (struct iterator iterator = first_group(); iterator.group; next_group(&iterator)) {
        for (size_t r = 0; r < iterator.group->row_count; r++) {
            if (!strcmp(iterator.group->rows[r].name, name))
                return &iterator.group->rows[r];
        }
    }
    return NULL;
}

enum {
    NAME_SIZE = 64,
    SOURCE_SIZE = 512, /* text size of an assignment's source */
};

struct assignment {
    struct settings *settings;
    const struct setting *row;
    const struct settings_source *source; /* NULL for --set */
};

/* Writes an assignment's source: "--set NAME", "FILE:LINE: NAME" or "FILE: NAME". */
static const char *format_source(const struct settings_source *source, const char *name,
                                 char text[static SOURCE_SIZE])
{
    if (!source)
        snprintf(text, SOURCE_SIZE, "--set%s%s", name[0] ? " " : "", name);
    else if (source->line)
        snprintf(text, SOURCE_SIZE, "%s:%u%s%s", source->path, source->line, name[0] ? ": " : "",
                 name);
    else
        snprintf(text, SOURCE_SIZE, "%s%s%s", source->path, name[0] ? ": " : "", name);
    return text;
}

/* Finds a setting by its former name, and logs its new name. Returns NULL if there is none. */
static const struct setting *find_renamed(const struct settings_source *source, const char *name)
{
    char where[SOURCE_SIZE];
    for (struct iterator iterator = first_group(); iterator.group; next_group(&iterator)) {
        for (size_t r = 0; r < iterator.group->row_count; r++) {
            const struct setting *row = &iterator.group->rows[r];
            if (row->renamed_from && !strcmp(row->renamed_from, name)) {
                log_note("%s is now named %s", format_source(source, name, where), row->name);
                return row;
            }
        }
    }
    return NULL;
}

static enum status rejection_status(const struct settings_source *source)
{
    return source ? STATUS_DATA : STATUS_USAGE;
}

static enum status reject_name(const struct settings_source *source, const char *name)
{
    struct suggest suggest = { .word = name };
    char hint[SUGGEST_HINT_SIZE], where[SOURCE_SIZE];
    for (struct iterator iterator = first_group(); iterator.group; next_group(&iterator)) {
        for (size_t r = 0; r < iterator.group->row_count; r++)
            suggest_offer(&suggest, iterator.group->rows[r].name);
    }
    log_error("%s: unknown setting '%s'%s (firn list settings)", format_source(source, "", where),
              name, suggest_hint(&suggest, hint));
    return rejection_status(source);
}

static enum status reject_value(const struct assignment *a, const char *value)
{
    const struct setting *row = a->row;
    char choices[256] = "", where[SOURCE_SIZE];
    size_t used = 0;
    for (size_t i = 0; row->choices && row->choices[i] && used < sizeof(choices); i++)
        used += (size_t)snprintf(&choices[used], sizeof(choices) - used, "%s%s", i ? ", " : "",
                                 row->choices[i]);
    format_source(a->source, row->name, where);
    if (row->type == SETTING_CHOICE)
        log_error("%s: expected one of %s, got '%s'", where, choices, value);
    else if (row->type == SETTING_SWITCH)
        log_error("%s: expected on or off, got '%s'", where, value);
    else
        log_error(
            "%s: expected %sa %s from %g to %g, got '%s'", where, row->has_auto ? "auto or " : "",
            row->type == SETTING_COUNT ? "whole number" : "number", row->min, row->max, value);
    return rejection_status(a->source);
}

static enum status set_number(const struct assignment *a, const char *text)
{
    const struct setting *row = a->row;
    char *end;
    double value = strtod(text, &end);
    if (row->has_auto && !strcmp(text, "auto")) {
        settings_set_value(a->settings, row, setting_auto(row));
        return STATUS_OK;
    }
    if (end == text || *end || isspace((unsigned char)*text) || !isfinite(value) ||
        value < row->min || value > row->max)
        return reject_value(a, text);
    if (row->type == SETTING_COUNT && floor(value) < value)
        return reject_value(a, text);
    settings_set_value(a->settings, row, value);
    return STATUS_OK;
}

static enum status set_choice(const struct assignment *a, const char *text)
{
    static const char *const switches[] = { "off", "on", NULL };
    const char *const *names = a->row->type == SETTING_SWITCH ? switches : a->row->choices;
    for (uint32_t i = 0; names[i]; i++) {
        if (!strcmp(names[i], text)) {
            settings_set_value(a->settings, a->row, i);
            return STATUS_OK;
        }
    }
    return reject_value(a, text);
}

enum status settings_assign(struct settings *settings, const char *assignment,
                            const struct settings_source *source, const struct setting **row)
{
    const char *equals = strchr(assignment, '=');
    size_t length = equals ? (size_t)(equals - assignment) : 0;
    char name[NAME_SIZE] = "", where[SOURCE_SIZE];
    *row = NULL;
    if (!equals || !length) {
        log_error("%s: expected NAME=VALUE, got '%s'", format_source(source, "", where),
                  assignment);
        return rejection_status(source);
    }
    memcpy(name, assignment, length < NAME_SIZE ? length : NAME_SIZE - 1);
    struct assignment a = { settings, settings_find(name), source };
    if (!a.row)
        a.row = find_renamed(source, name);
    if (!a.row || length >= NAME_SIZE)
        return reject_name(source, name);
    const bool is_number = a.row->type == SETTING_FLOAT || a.row->type == SETTING_COUNT;
    const enum status status = is_number ? set_number(&a, equals + 1) : set_choice(&a, equals + 1);
    if (status == STATUS_OK)
        *row = a.row;
    return status;
}

enum status settings_set(struct settings *settings, const char *assignment)
{
    const struct setting *row;
    return settings_assign(settings, assignment, NULL, &row);
}

size_t settings_index(const struct setting *row)
{
    return row_offset(row) / sizeof(float);
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

static bool is_changed(const struct settings *settings, const struct settings *defaults,
                       const struct setting *row)
{
    const double a = settings_get(settings, row);
    const double b = settings_get(defaults, row);
    return a < b || a > b;
}

void settings_print_changes(const struct settings *settings, const char *before, FILE *out)
{
    const struct settings defaults = settings_default();
    const struct setting_group *group;
    for (size_t g = 0; (group = settings_group(g)); g++) {
        for (size_t r = 0; r < group->row_count; r++) {
            const struct setting *row = &group->rows[r];
            if (!is_changed(settings, &defaults, row))
                continue;
            fprintf(out, "%s%s=", before, row->name);
            settings_print(settings, row, out);
            fputc('\n', out);
        }
    }
}
