/* option.h: declaration of a command-line option, and the type of its setter function. */
#ifndef FIRN_APP_OPTIONS_OPTION_H
#define FIRN_APP_OPTIONS_OPTION_H

#include "src/app/app.h"

struct option;

/* Sets the field at `at` to an option's value. `value` is NULL if the option is given without one.
 * If the value is invalid, logs an error and returns STATUS_USAGE. */
typedef enum status option_fn(const struct option *option, void *at, const char *value);

struct option {
    const char *group; /* heading in the help */
    const char *name;  /* without dashes */
    char letter;       /* short name, or 0 */
    const char *value; /* name of the value in the help, or NULL for a flag */
    unsigned commands; /* bits of enum app_command */
    size_t offset;     /* offset in struct app_options */
    option_fn *set;
    const char *help;
    double min, max;  /* range of numbers; max of option_output is a number of files */
    const char *unit; /* after a number's range: " degrees"; option_output: ", or -"; or NULL */
    const char *const *words; /* choices, or endings of file names, terminated by NULL */
};

#endif
