/* settings.c: the list of all groups, and values by name. */
#include "src/settings/settings.h"
#include <assert.h>
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/reference/reference_settings.h"
#include "src/settings/scene_settings.h"
#include "src/tech/air.h"
#include "src/tech/bubbles.h"
#include "src/tech/bump.h"
#include "src/tech/caustics.h"
#include "src/tech/cracks.h"
#include "src/tech/env_cube.h"
#include "src/tech/frost.h"
#include "src/tech/ice_caustics.h"
#include "src/tech/ice_interval.h"
#include "src/tech/refract.h"
#include "src/tech/refract_blend.h"
#include "src/tech/refract_bounce.h"
#include "src/tech/refract_paper.h"
#include "src/tech/refract_search.h"
#include "src/tech/surface.h"
#include "src/tech/tonemap.h"
#include "src/tech/water.h"

const struct setting_group *const setting_groups[] = {
    &object_settings,
    &landscape_settings,
    &sky_settings,
    &texture_settings,
    &motion_settings,
    &light_settings,
    &env_cube_settings,
    &refract_settings,
    &refract_paper_settings,
    &refract_blend_settings,
    &refract_search_settings,
    &refract_bounce_settings,
    &absorb_settings,
    &local_settings,
    &reference_settings,
    &air_settings,
    &bubbles_settings,
    &cracks_settings,
    &ice_interval_settings,
    &bump_settings,
    &surface_settings,
    &frost_settings,
    &ice_caustics_settings,
    &pool_settings,
    &water_settings,
    &caustics_settings,
    &tonemap_settings,
    NULL,
};

/* Where a group's struct begins; groups lie one after another, 16 bytes aligned. */
static size_t group_offset(const struct setting_group *group)
{
    size_t offset = 0;
    for (size_t g = 0; setting_groups[g] != group; g++) {
        assert(setting_groups[g]); /* the group is in the list */
        offset += (setting_groups[g]->params_size + 15) / 16 * 16;
    }
    assert(offset + group->params_size <= SETTINGS_SIZE);
    return offset;
}

const void *settings_of(const struct settings *settings, const struct setting_group *group)
{
    return &settings->values[group_offset(group)];
}

static size_t row_offset(const struct setting *row)
{
    for (size_t g = 0; setting_groups[g]; g++) {
        const struct setting_group *group = setting_groups[g];
        if (row >= group->rows && row < group->rows + group->row_count)
            return group_offset(group) + row->offset;
    }
    assert(false && "the row is in a listed group");
    return 0;
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

struct settings settings_default(void)
{
    struct settings settings = { 0 };
    for (size_t g = 0; setting_groups[g]; g++) {
        for (size_t r = 0; r < setting_groups[g]->row_count; r++)
            settings_put(&settings, &setting_groups[g]->rows[r],
                         setting_groups[g]->rows[r].initial);
    }
    return settings;
}

const struct setting *settings_find(const char *name)
{
    for (size_t g = 0; setting_groups[g]; g++) {
        for (size_t r = 0; r < setting_groups[g]->row_count; r++) {
            if (!strcmp(setting_groups[g]->rows[r].name, name))
                return &setting_groups[g]->rows[r];
        }
    }
    return NULL;
}

enum {
    NAME_SIZE = 64
};

/* Levenshtein distance, of texts shorter than NAME_SIZE. */
static size_t edit_distance(const char *a, const char *b)
{
    size_t row[NAME_SIZE + 1];
    size_t length = strlen(b);
    for (size_t j = 0; j <= length; j++)
        row[j] = j;
    for (size_t i = 0; a[i]; i++) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < length; j++) {
            size_t best = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            if (best > row[j] + 1)
                best = row[j] + 1;
            if (best > row[j + 1] + 1)
                best = row[j + 1] + 1;
            row[j + 1] = best;
        }
    }
    return row[length];
}

static const char *nearest_name(const char *name)
{
    const char *nearest = "";
    size_t best = SIZE_MAX;
    for (size_t g = 0; setting_groups[g]; g++) {
        for (size_t r = 0; r < setting_groups[g]->row_count; r++) {
            size_t distance = edit_distance(name, setting_groups[g]->rows[r].name);
            if (distance < best) {
                best = distance;
                nearest = setting_groups[g]->rows[r].name;
            }
        }
    }
    return nearest;
}

static enum status refuse(const struct setting *row, const char *value)
{
    char choices[256] = "";
    size_t used = 0;
    for (size_t i = 0; row->choices && row->choices[i] && used < sizeof(choices); i++)
        used += (size_t)snprintf(&choices[used], sizeof(choices) - used, "%s%s", i ? ", " : "",
                                 row->choices[i]);
    if (row->type == SETTING_CHOICE)
        log_error("--set %s=%s: one of %s is wanted", row->name, value, choices);
    else if (row->type == SETTING_SWITCH)
        log_error("--set %s=%s: on or off is wanted", row->name, value);
    else
        log_error("--set %s=%s: a %s from %g to %g is wanted", row->name, value,
                  row->type == SETTING_COUNT ? "whole number" : "number", row->min, row->max);
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
        log_error("--set %s: name=value is wanted", assignment);
        return STATUS_USAGE;
    }
    memcpy(name, assignment, length < NAME_SIZE ? length : NAME_SIZE - 1);
    const struct setting *row = settings_find(name);
    if (!row || length >= NAME_SIZE) {
        log_error("--set %s: no such setting; did you mean %s? (firn list settings)", name,
                  nearest_name(name));
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
