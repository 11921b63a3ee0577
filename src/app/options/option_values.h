/* option_values.h: values on the command line, and options that only take one over. */
#ifndef FIRN_APP_OPTIONS_OPTION_VALUES_H
#define FIRN_APP_OPTIONS_OPTION_VALUES_H

#include "src/app/options/option.h"

/* Of a bool, a string that is taken as it is, and a uint32_t from option->min to max. */
option_fn option_flag, option_text, option_count;

/* Whether its value comes with '=' or not at all. */
bool option_is_optional(const struct option *option);

/* Logs "--option: expected EXPECTED, got 'value'". STATUS_USAGE. */
enum status option_refuse(const struct option *option, const char *value, const char *expected);

/* Logs that an option was given more than `most` times, last with `value`. STATUS_USAGE. */
enum status option_refuse_more(const struct option *option, const char *value, uint32_t most);

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
enum status option_refuse_name(const struct option *option, enum option_names names,
                               const char *word, size_t length);

/* One file more. Logs: STATUS_USAGE. */
enum status option_add_output(const struct option *option, struct app_outputs *outputs,
                              const char *value);

/* Which of the words it is; -1: none. */
int option_find_word(const char *const *words, int count, const char *value);

/* Numbers with a separator between; true if there are exactly `count`, all finite. */
bool option_parse_numbers(const char *text, char separator, float *numbers, size_t count);

/* A number from min to max, digits alone; *rest is what follows it. */
bool option_parse_count(const char *text, uint32_t min, uint32_t max, uint32_t *count,
                        const char **rest);

#endif
