/* option.h: what sets an option. */
#ifndef FIRN_APP_OPTIONS_OPTION_H
#define FIRN_APP_OPTIONS_OPTION_H

#include "src/app/app.h"

/* `value` is NULL if the option takes none. Logs: STATUS_USAGE. */
typedef enum status option_fn(struct app_options *o, const char *value);

#endif
