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
    uint32_t min, max; /* range of option_count */
    const char *unit;  /* " of seconds", or NULL */
};

#endif
