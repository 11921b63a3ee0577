/* option_values.h: parsers of numbers and names on the command line, and simple option setters. */
#ifndef FIRN_APP_OPTIONS_OPTION_VALUES_H
#define FIRN_APP_OPTIONS_OPTION_VALUES_H

#include "src/app/options/option.h"

/* Setters of a flag (to true), a string, and numbers from option->min to option->max. */
option_fn option_flag, option_text, option_count; /* of bool, const char *, uint32_t */
option_fn option_float, option_double;

/* Sets an enumeration to the index of the value in option->words, which begin at option->min. */
option_fn option_word;

/* Adds an output file whose name ends in one of option->words, or is "-" if option->unit allows. */
option_fn option_output; /* of struct setup_outputs */

/* Returns true for options whose value may be left out, such as --name[=VALUE]. */
bool option_is_optional(const struct option *option);

/* Logs "--option: expected EXPECTED, got 'value'". Returns STATUS_USAGE. */
enum status option_refuse(const struct option *option, const char *value, const char *expected);

/* Logs that an option was given more than `max_count` times. Returns STATUS_USAGE. */
enum status option_refuse_more(const struct option *option, const char *value, uint32_t max_count);

enum option_names {
    OPTION_REFRACTION_MODELS,
    OPTION_REFRACTION_MODELS_AND_REFERENCE,
    OPTION_MATERIALS,
    OPTION_LAYERS,
};

/* Logs that the first `length` characters of `word` are not a known name. The message suggests a
 * similar name and the command firn list. Returns STATUS_USAGE. */
enum status option_refuse_name(const struct option *option, enum option_names names,
                               const char *word, size_t length);

/* Parses names separated by commas. Sets bit i of *bits for the i-th known name, and *all for the
 * name "all"; NULL if that is no name. */
enum status option_parse_names(const struct option *option, enum option_names names,
                               const char *value, uint64_t *bits, bool *all);

/* Returns the index of `value` in the array of words, or -1 if the array does not contain it. */
int option_find_word(const char *const *names, int count, const char *value);

enum {
    OPTION_NUMBERS_MAX = 7, /* maximum `count` of option_parse_numbers() */
};

/* Parses numbers between separators. Returns true if there are exactly `count`, all finite. */
bool option_parse_doubles(const char *text, char separator, double *numbers, size_t count);
bool option_parse_numbers(const char *text, char separator, float *numbers, size_t count);

/* Parses a decimal number from min to max. *rest points to the text after it. */
bool option_parse_count(const char *text, uint32_t min, uint32_t max, uint32_t *count,
                        const char **rest);

#endif
