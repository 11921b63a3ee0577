/* option_reference.h: what the options of --refraction reference set. */
#ifndef FIRN_APP_OPTIONS_OPTION_REFERENCE_H
#define FIRN_APP_OPTIONS_OPTION_REFERENCE_H

#include "src/app/options/option.h"

option_fn option_noise, option_seconds; /* of a double */

/* Returns the output beside which --keep-sums keeps the sums, or NULL. */
const char *option_sums_picture(const struct app_options *options);

/* Returns the name of the file with a picture's sums, "a.sums.exr" for "a.exr", malloc'd; NULL when
 * out of memory. */
char *option_sums_file(const char *picture);

/* Whether what firn render was told of the reference suits its rung, and how many samples there are
 * at most where nothing said so. Logs: STATUS_USAGE. */
MUST_USE enum status option_settle_reference(struct app_options *options);

#endif
