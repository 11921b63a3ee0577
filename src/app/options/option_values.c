/* option_values.c: parsers of numbers and names on the command line, and simple option setters. */
#include "src/app/options/option_values.h"
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/suggest.h"
#include "src/scene/material.h"
#include "src/tech/refract/cpu_reference_settings.h"
#include "src/tech/techniques.h"

bool option_is_optional(const struct option *option)
{
    return option->value && option->value[0] == '[';
}

enum status option_refuse(const struct option *option, const char *value, const char *expected)
{
    log_error("--%s: expected %s, got '%s'", option->name, expected, value);
    return STATUS_USAGE;
}

enum status option_refuse_more(const struct option *option, const char *value, uint32_t max_count)
{
    log_error("--%s: can be given at most %u times; leave out '%s'", option->name, max_count,
              value);
    return STATUS_USAGE;
}

static void offer_names(struct suggest *suggest, enum option_names names)
{
    const bool has_reference = names == OPTION_REFRACTION_MODELS_AND_REFERENCE;
    for (size_t i = 0;
         (names == OPTION_REFRACTION_MODELS || has_reference) && techniques_refraction(i); i++)
        suggest_offer(suggest, techniques_refraction(i)->refraction.name);
    if (has_reference)
        suggest_offer(suggest, cpu_reference_settings.refraction.name);
    for (const struct material_preset *m = material_presets; names == OPTION_MATERIALS && m->name;
         m++)
        suggest_offer(suggest, m->name);
    for (size_t i = 0; names == OPTION_LAYERS && techniques_layer(i); i++)
        suggest_offer(suggest, techniques_layer(i)->name);
}

/* Returns true for the names of refraction models of earlier versions. */
static bool is_removed_model(const char *name)
{
    return !strcmp(name, "slab") || !strcmp(name, "sphere") || !strcmp(name, "blend");
}

enum status option_refuse_name(const struct option *option, enum option_names names,
                               const char *word, size_t length)
{
    static const struct {
        const char *singular, *list;
    } kinds[] = {
        [OPTION_REFRACTION_MODELS] = { "refraction model", "refractions" },
        [OPTION_REFRACTION_MODELS_AND_REFERENCE] = { "refraction model", "refractions" },
        [OPTION_MATERIALS] = { "material", "materials" },
        [OPTION_LAYERS] = { "layer", "layers" },
    };

    char name[SUGGEST_NAME_SIZE];
    char hint[SUGGEST_HINT_SIZE];
    struct suggest suggest = { .word = name };
    snprintf(name, sizeof(name), "%.*s", (int)(length < sizeof(name) ? length : sizeof(name)),
             word);
    offer_names(&suggest, names);
    if (names != OPTION_MATERIALS && names != OPTION_LAYERS && is_removed_model(name))
        log_error("--%s %s: removed; use one-sided", option->name, name);
    else if (names == OPTION_REFRACTION_MODELS &&
             !strcmp(name, cpu_reference_settings.refraction.name))
        log_error("--%s: refraction model '%s' is only available with firn render --refraction",
                  option->name, name);
    else
        log_error("--%s: unknown %s '%s'%s (firn list %s)", option->name, kinds[names].singular,
                  name, suggest_hint(&suggest, hint), kinds[names].list);
    return STATUS_USAGE;
}

bool option_parse_doubles(const char *text, char separator, double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char *end;
        if (isspace((unsigned char)*text))
            return false;
        double value = strtod(text, &end);
        bool last = i + 1 == count;
        if (end == text || !(fabs(value) <= 1e30) || *end != (last ? '\0' : separator))
            return false;
        numbers[i] = value;
        text = end + !last;
    }
    return true;
}

bool option_parse_numbers(const char *text, char separator, float *numbers, size_t count)
{
    double values[OPTION_NUMBERS_MAX];
    if (!option_parse_doubles(text, separator, values, count))
        return false;
    for (size_t i = 0; i < count; i++)
        numbers[i] = (float)values[i];
    return true;
}

bool option_parse_count(const char *text, uint32_t min, uint32_t max, uint32_t *count,
                        const char **rest)
{
    char *end;
    if (!isdigit((unsigned char)*text))
        return false;
    errno = 0;
    unsigned long value = strtoul(text, &end, 10);
    if (errno || value < min || value > max)
        return false;
    *count = (uint32_t)value;
    *rest = end;
    return true;
}

int option_find_word(const char *const *names, int count, const char *value)
{
    int i = 0;
    while (i < count && strcmp(names[i], value) != 0)
        i++;
    return i < count ? i : -1;
}

enum status option_add_output(const struct option *option, struct setup_outputs *outputs,
                              const char *value)
{
    if (outputs->count == SETUP_OUTPUT_COUNT)
        return option_refuse_more(option, value, SETUP_OUTPUT_COUNT);
    outputs->paths[outputs->count++] = value;
    return STATUS_OK;
}

enum status option_flag(const struct option *option, void *at, const char *value)
{
    bool *flag = at;
    (void)option;
    (void)value;
    *flag = true;
    return STATUS_OK;
}

enum status option_text(const struct option *option, void *at, const char *value)
{
    const char **text = at;
    (void)option;
    *text = value;
    return STATUS_OK;
}

enum status option_count(const struct option *option, void *at, const char *value)
{
    char expected[64];
    const char *rest;
    if (option_parse_count(value, option->min, option->max, at, &rest) && !*rest)
        return STATUS_OK;
    snprintf(expected, sizeof(expected), "a whole number%s from %u to %u",
             option->unit ? option->unit : "", option->min, option->max);
    return option_refuse(option, value, expected);
}
