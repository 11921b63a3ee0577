/* option_values.h: numbers on the command line. */
#ifndef FIRN_APP_OPTIONS_OPTION_VALUES_H
#define FIRN_APP_OPTIONS_OPTION_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/base/status.h"

/* Logs "--option value: wanted". STATUS_USAGE. */
enum status option_refuse(const char *option, const char *value, const char *wanted);

/* Numbers with a separator between; true if there are exactly `count`, all finite. */
bool option_parse_numbers(const char *text, char separator, float *numbers, size_t count);

/* A number from min to max, digits alone; *rest is what follows it. */
bool option_parse_count(const char *text, uint32_t min, uint32_t max, uint32_t *count,
                        const char **rest);

#endif
