/* reference_options.h: setters and checks of the options of --refraction reference. */
#ifndef FIRN_APP_OPTIONS_REFERENCE_OPTIONS_H
#define FIRN_APP_OPTIONS_REFERENCE_OPTIONS_H

#include "src/app/options/option.h"

option_fn option_noise, option_seconds; /* of a double */

/* Returns the first EXR output, or NULL. --keep-sums stores the sample sums beside this file. */
const char *option_sums_image(const struct app_options *options);

/* Returns the file name of an image's sample sums: "a.sums.exr" for "a.exr". The caller frees the
 * name. If out of memory, returns NULL. */
char *option_sums_file(const char *image);

/* If options of the path tracer are given without --refraction reference, logs an error and returns
 * STATUS_USAGE. Sets the default sample count and pixel filter. */
MUST_USE enum status option_check_reference(struct app_options *options);

#endif
