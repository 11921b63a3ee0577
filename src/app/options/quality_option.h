/* quality_option.h: applies the quality level of --quality. */
#ifndef FIRN_APP_OPTIONS_QUALITY_OPTION_H
#define FIRN_APP_OPTIONS_QUALITY_OPTION_H

#include "src/app/options/option.h"

/* Sets the quality level of a struct setup_image. Values of --set and --preset take precedence. */
option_fn option_quality;

/* Applies the default quality if no --quality, --samples, --preset, --noise or --time is given. */
void option_default_quality(struct app_options *o);

#endif
