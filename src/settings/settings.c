/* settings.c: the list of all groups, and values by name. */
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

/* Those that belong to no technique come first. */
static const struct setting_group *const scene_groups[] = {
    &object_settings, &landscape_settings, &sky_settings,      &texture_settings,
    &motion_settings, &light_settings,     &env_cube_settings,
};

enum {
    SCENE_GROUP_COUNT = sizeof(scene_groups) / sizeof(scene_groups[0])
};

/* A walk over all groups, for whoever needs more than one of them. */
struct walk {
    const struct setting_group *group; /* NULL at the end */
    size_t offset;                     /* of its struct: one lies after another, 16 bytes aligned */
    const struct technique *const *technique;
    size_t index; /* among the scene's groups, or the technique's */
};

static struct walk first_group(void)
{
    return (struct walk){ .group = scene_groups[0] };
}

static void next_group(struct walk *walk)
{
    walk->offset += (walk->group->params_size + 15) / 16 * 16;
    walk->group = NULL;
    walk->index++;
    if (!walk->technique && walk->index < SCENE_GROUP_COUNT)
        walk->group = scene_groups[walk->index];
    if (!walk->technique && walk->index == SCENE_GROUP_COUNT) {
        walk->technique = techniques;
        walk->index = 0;
    }
    while (!walk->group && walk->technique && *walk->technique) {
        if (walk->index < TECHNIQUE_GROUP_COUNT)
            walk->group = (*walk->technique)->settings[walk->index];
        if (!walk->group) {
            walk->technique++;
            walk->index = 0;
        }
    }
}

const struct setting_group *settings_group(size_t i)
{
    struct walk walk = first_group();
    while (walk.group && i-- > 0)
        next_group(&walk);
    return walk.group;
}

static size_t group_offset(const struct setting_group *group)
{
    struct walk walk = first_group();
    while (walk.group != group) {
        next_group(&walk);
        assert(walk.group); /* the group is in the list */
    }
    assert(walk.offset + group->params_size <= SETTINGS_SIZE);
    return walk.offset;
}

const void *settings_of(const struct settings *settings, const struct setting_group *group)
{
    return &settings->values[group_offset(group)];
}

static size_t row_offset(const struct setting *row)
{
    for (struct walk walk = first_group(); walk.group; next_group(&walk)) {
        if (row >= walk.group->rows && row < walk.group->rows + walk.group->row_count)
            return walk.offset + row->offset;
    }
    assert(false && "the row is in a listed group");
    return 0;
}

const struct setting *settings_row(const struct setting_group *group, size_t offset)
{
    size_t i = 0;
    while (i < group->row_count && group->rows[i].offset != offset)
        i++;
    assert(i < group->row_count); /* every field has a row */
    return &group->rows[i];
}

void settings_put(struct settings *settings, const struct setting *row, double value)
{
    unsigned char *field = &settings->values[row_offset(row)];
    if (row->type == SETTING_FLOAT)
        memcpy(field, &(float){ (float)value }, sizeof(float));
    else
        memcpy(field, &(uint32_t){ (uint32_t)value }, sizeof(uint32_t));
}

double settings_get(const struct settings *settings, const struct setting *row)
{
    const unsigned char *field = &settings->values[row_offset(row)];
    float number;
    uint32_t count;
    if (row->type == SETTING_FLOAT) {
        memcpy(&number, field, sizeof(number));
        return (double)number;
    }
    memcpy(&count, field, sizeof(count));
    return count;
}

static size_t field_of(const struct setting *row)
{
    return row_offset(row) / sizeof(float); /* every field has this size */
}

void settings_rows_add(struct settings_rows *rows, const struct setting *row)
{
    rows->bits[field_of(row) / 64] |= UINT64_C(1) << field_of(row) % 64;
}

bool settings_rows_have(const struct settings_rows *rows, const struct setting *row)
{
    return rows->bits[field_of(row) / 64] >> field_of(row) % 64 & 1;
}

void settings_rows_add_assigned(struct settings_rows *rows, const char *assignment)
{
    char name[64];
    snprintf(name, sizeof(name), "%.*s", (int)strcspn(assignment, "="), assignment);
    const struct setting *row = settings_find(name);
    if (row)
        settings_rows_add(rows, row);
}

enum setting_effect settings_changed(const struct settings *before, const struct settings *after)
{
    enum setting_effect most = SETTING_AFFECTS_NOTHING;
    for (struct walk walk = first_group(); walk.group; next_group(&walk)) {
        for (size_t r = 0; r < walk.group->row_count; r++) {
            const struct setting *row = &walk.group->rows[r];
            const double a = settings_get(before, row), b = settings_get(after, row);
            if (!(a < b) && !(a > b))
                continue;
            most = most > SETTING_AFFECTS_FRAME ? most : SETTING_AFFECTS_FRAME;
            most = most > row->affects ? most : row->affects;
            if (!(a > 0.0 || a < 0.0) != !(b > 0.0 || b < 0.0))
                most = most > row->switches ? most : row->switches;
        }
    }
    return most;
}

struct settings settings_default(void)
{
    struct settings settings = { 0 };
    for (struct walk walk = first_group(); walk.group; next_group(&walk)) {
        for (size_t r = 0; r < walk.group->row_count; r++)
            settings_put(&settings, &walk.group->rows[r], walk.group->rows[r].initial);
    }
    return settings;
}

const struct setting *settings_find(const char *name)
{
    for (struct walk walk = first_group(); walk.group; next_group(&walk)) {
        for (size_t r = 0; r < walk.group->row_count; r++) {
            if (!strcmp(walk.group->rows[r].name, name))
                return &walk.group->rows[r];
        }
    }
    return NULL;
}

enum {
    NAME_SIZE = 64
};

static void refuse_name(const char *name)
{
    struct suggest suggest = { .word = name };
    char hint[SUGGEST_HINT_SIZE];
    for (struct walk walk = first_group(); walk.group; next_group(&walk)) {
        for (size_t r = 0; r < walk.group->row_count; r++)
            suggest_offer(&suggest, walk.group->rows[r].name);
    }
    log_error("--set: unknown setting '%s'%s (firn list settings)", name,
              suggest_hint(&suggest, hint));
}

static enum status refuse(const struct setting *row, const char *value)
{
    char choices[256] = "";
    size_t used = 0;
    for (size_t i = 0; row->choices && row->choices[i] && used < sizeof(choices); i++)
        used += (size_t)snprintf(&choices[used], sizeof(choices) - used, "%s%s", i ? ", " : "",
                                 row->choices[i]);
    if (row->type == SETTING_CHOICE)
        log_error("--set %s: expected one of %s, got '%s'", row->name, choices, value);
    else if (row->type == SETTING_SWITCH)
        log_error("--set %s: expected on or off, got '%s'", row->name, value);
    else
        log_error("--set %s: expected a %s from %g to %g, got '%s'", row->name,
                  row->type == SETTING_COUNT ? "whole number" : "number", row->min, row->max,
                  value);
    return STATUS_USAGE;
}

static enum status set_number(struct settings *settings, const struct setting *row,
                              const char *text)
{
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end || isspace((unsigned char)*text) || !isfinite(value) ||
        value < row->min || value > row->max)
        return refuse(row, text);
    if (row->type == SETTING_COUNT && floor(value) < value)
        return refuse(row, text);
    settings_put(settings, row, value);
    return STATUS_OK;
}

static enum status set_word(struct settings *settings, const struct setting *row, const char *text)
{
    static const char *const switches[] = { "off", "on", NULL };
    const char *const *words = row->type == SETTING_SWITCH ? switches : row->choices;
    for (uint32_t i = 0; words[i]; i++) {
        if (!strcmp(words[i], text)) {
            settings_put(settings, row, i);
            return STATUS_OK;
        }
    }
    return refuse(row, text);
}

enum status settings_set(struct settings *settings, const char *assignment)
{
    const char *equals = strchr(assignment, '=');
    size_t length = equals ? (size_t)(equals - assignment) : 0;
    char name[NAME_SIZE] = "";
    if (!equals || !length) {
        log_error("--set: expected NAME=VALUE, got '%s'", assignment);
        return STATUS_USAGE;
    }
    memcpy(name, assignment, length < NAME_SIZE ? length : NAME_SIZE - 1);
    const struct setting *row = settings_find(name);
    if (!row || length >= NAME_SIZE) {
        refuse_name(name);
        return STATUS_USAGE;
    }
    if (row->type == SETTING_FLOAT || row->type == SETTING_COUNT)
        return set_number(settings, row, equals + 1);
    return set_word(settings, row, equals + 1);
}

/* 9 digits are always enough */
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
    else if (row->type == SETTING_COUNT)
        fprintf(out, "%.0f", value);
    else
        settings_print_number((float)value, out);
}
