/* reference_options.h: setters and checks of the options of --refraction reference. */
#ifndef FIRN_APP_OPTIONS_REFERENCE_OPTIONS_H
#define FIRN_APP_OPTIONS_REFERENCE_OPTIONS_H

#include "src/app/options/option.h"

option_fn option_noise, option_seconds; /* of a double */

/* Returns the first EXR output, or NULL. --keep-sums stores the sample sums beside this file. */
const char *option_sums_image(const struct app_options *options);

/* Returns the name of an image's file of sample sums, "a.sums.exr" for "a.exr". The caller frees
 * the name. Returns NULL when out of memory. */
char *option_sums_file(const char *image);

/* Checks that options of the path tracer are given only with --refraction reference. Sets its
 * default sample count and pixel filter. On failure logs and returns STATUS_USAGE. */
MUST_USE enum status option_check_reference(struct app_options *options);

#endif
