/* option_values.c: parsers of numbers and names on the command line, and simple option setters. */
#include "src/app/options/option_values.h"
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/base/suggest.h"
#include "src/scene/material_presets.h"
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

/* Returns true for the names of refraction models of earlier versions. */
static bool is_removed_model(const char *name)
{
    return !strcmp(name, "slab") || !strcmp(name, "sphere") || !strcmp(name, "blend");
}

/* Returns the i-th name, or NULL if there are fewer. */
static const char *name_at(enum option_names names, uint32_t i)
{
    if (names == OPTION_MATERIALS)
        return material_presets[i].name;
    if (names == OPTION_LAYERS)
        return techniques_layer(i) ? techniques_layer(i)->name : NULL;
    if (techniques_refraction(i))
        return techniques_refraction(i)->refraction.name;
    return names == OPTION_REFRACTION_MODELS_AND_REFERENCE && techniques_refraction(i - 1)
               ? cpu_reference_settings.refraction.name
               : NULL;
}

/* Refuses the unknown finish of a known material, such as "glass:smooth". Returns true if so. */
static bool refuse_finish(const struct option *option, const char *name)
{
    struct material_choice choice;
    char hint[SUGGEST_HINT_SIZE];
    if (material_choice_parse(&choice, name, strlen(name)) || !choice.preset)
        return false;
    struct suggest suggest = { .word = name + strlen(choice.preset->name) + 1 };
    for (const struct material_finish *f = material_finishes; f->name; f++)
        suggest_offer(&suggest, f->name);
    log_error("--%s: unknown finish '%s' of %s%s; expected rough or frosted", option->name,
              suggest.word, choice.preset->name, suggest_hint(&suggest, hint));
    return true;
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
    if (names == OPTION_MATERIALS && refuse_finish(option, name))
        return STATUS_USAGE;
    if (names == OPTION_MATERIALS)
        name[strcspn(name, ":")] = '\0';
    for (uint32_t i = 0; name_at(names, i); i++)
        suggest_offer(&suggest, name_at(names, i));
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

enum status option_parse_names(const struct option *option, enum option_names names,
                               const char *value, uint64_t *bits, bool *all)
{
    for (const char *word = value;; word++) {
        const size_t length = strcspn(word, ",");
        uint32_t i = 0;
        const char *name;
        while ((name = name_at(names, i)) &&
               (strlen(name) != length || strncmp(name, word, length) != 0))
            i++;
        if (name)
            *bits |= UINT64_C(1) << i;
        else if (all && length == 3 && !strncmp(word, "all", 3))
            *all = true;
        else
            return option_refuse_name(option, names, word, length);
        word += length;
        if (!*word)
            return STATUS_OK;
    }
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

static enum status refuse_number(const struct option *option, const char *value, const char *kind)
{
    char expected[80];
    snprintf(expected, sizeof(expected), "%s%.9g to %.9g%s", kind, option->min, option->max,
             option->unit ? option->unit : "");
    return option_refuse(option, value, expected);
}

enum status option_count(const struct option *option, void *at, const char *value)
{
    const char *rest;
    return option_parse_count(value, (uint32_t)option->min, (uint32_t)option->max, at, &rest) &&
                   !*rest
               ? STATUS_OK
               : refuse_number(option, value, "a whole number from ");
}

enum status option_float(const struct option *option, void *at, const char *value)
{
    float number;
    if (!option_parse_numbers(value, ',', &number, 1) || number < (float)option->min ||
        number > (float)option->max)
        return refuse_number(option, value, "");
    *(float *)at = number;
    return STATUS_OK;
}

enum status option_double(const struct option *option, void *at, const char *value)
{
    float number;
    const enum status status = option_float(option, &number, value);
    if (status == STATUS_OK)
        *(double *)at = (double)number;
    return status;
}

/* Logs that a value is none of option->words. Returns STATUS_USAGE. */
static enum status refuse_word(const struct option *option, const char *value, const char *kind)
{
    char expected[80];
    size_t used = (size_t)snprintf(expected, sizeof(expected), "%s", kind);
    for (size_t first = (size_t)option->min, i = first; option->words[i]; i++)
        used += (size_t)snprintf(&expected[used], sizeof(expected) - used, "%s%s",
                                 i == first             ? ""
                                 : option->words[i + 1] ? ", "
                                                        : " or ",
                                 option->words[i]);
    snprintf(&expected[used], sizeof(expected) - used, "%s", option->unit ? option->unit : "");
    return option_refuse(option, value, expected);
}

enum status option_word(const struct option *option, void *at, const char *value)
{
    uint32_t *index = at;
    for (uint32_t i = (uint32_t)option->min; option->words[i]; i++) {
        if (!strcmp(option->words[i], value)) {
            *index = i;
            return STATUS_OK;
        }
    }
    return refuse_word(option, value, "");
}

enum status option_output(const struct option *option, void *at, const char *value)
{
    struct setup_outputs *outputs = at;
    bool is_known = option->unit && !strcmp(value, "-");
    for (size_t i = 0; option->words[i]; i++)
        is_known = is_known || path_ends_in(value, option->words[i]);
    if (!is_known)
        return refuse_word(option, value, "a file name that ends in ");
    if (outputs->count == (uint32_t)option->max)
        return option_refuse_more(option, value, outputs->count);
    outputs->paths[outputs->count++] = value;
    return STATUS_OK;
}
