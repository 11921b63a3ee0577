/* option_values.h: numbers on the command line. */
#ifndef FIRN_APP_OPTIONS_OPTION_VALUES_H
#define FIRN_APP_OPTIONS_OPTION_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/base/status.h"

/* Logs "--option: expected EXPECTED, got 'value'". STATUS_USAGE. */
enum status option_refuse(const char *option, const char *value, const char *expected);

/* Logs that an option was given more than `most` times, last with `value`. STATUS_USAGE. */
enum status option_refuse_more(const char *option, const char *value, uint32_t most);

enum option_names {
    OPTION_RUNGS,
    OPTION_RUNGS_AND_REFERENCE,
    OPTION_MATERIALS,
    OPTION_LAYERS,
};

/*
 * Logs that the first `length` characters of `word` are none of these names, suggesting a close one
 * and the list to look at. STATUS_USAGE.
 */
enum status option_refuse_name(const char *option, enum option_names names, const char *word,
                               size_t length);

/* Numbers with a separator between; true if there are exactly `count`, all finite. */
bool option_parse_numbers(const char *text, char separator, float *numbers, size_t count);

/* A number from min to max, digits alone; *rest is what follows it. */
bool option_parse_count(const char *text, uint32_t min, uint32_t max, uint32_t *count,
                        const char **rest);

#endif
