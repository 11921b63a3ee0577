/* option.h: a row of the table of options, and what sets it. */
#ifndef FIRN_APP_OPTIONS_OPTION_H
#define FIRN_APP_OPTIONS_OPTION_H

#include "src/app/app.h"

struct option;

/* `at` is what the row's offset leads to; `value` is NULL if there is none. Logs: STATUS_USAGE. */
typedef enum status option_fn(const struct option *option, void *at, const char *value);

struct option {
    const char *group; /* heading in the help */
    const char *name;  /* without dashes */
    char letter;       /* 0: none */
    const char *value; /* NULL: takes none; "[=VALUE]": may be left out, and is then NULL */
    unsigned commands; /* enum app_command */
    size_t offset;     /* of what it sets, in struct app_options */
    option_fn *set;
    const char *help;
    uint32_t min, max; /* of option_count, as is: */
    const char *unit;  /* " of seconds"; NULL: none */
};

#endif
