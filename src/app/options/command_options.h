/* command_options.h: setters and defaults of options that few commands accept. */
#ifndef FIRN_APP_OPTIONS_COMMAND_OPTIONS_H
#define FIRN_APP_OPTIONS_COMMAND_OPTIONS_H

#include "src/app/options/option.h"

option_fn option_exposure, option_fail_above;    /* of struct app_diff */
option_fn option_farm_sbatch, option_farm_hosts; /* of struct app_farm */
option_fn option_refraction_models;              /* of struct app_ladder */
option_fn option_clock;                          /* of enum rg_clock */
option_fn option_sweep;                          /* of struct app_sweeps */
option_fn option_present, option_watch;          /* of struct setup_window */
option_fn option_split;                          /* of struct setup_image */

/* Sets the quality level of a struct setup_image. Values of --set and --preset take precedence. */
option_fn option_quality;

/* Applies the default quality if no --quality, --samples, --preset, --noise or --time is given. */
void option_default_quality(struct app_options *o, enum app_command command);

/* Sets the defaults of firn ladder: exact refraction, without effects that the path tracer does not
 * draw. Must be called before the options are parsed. */
void option_ladder_settings(struct settings *settings);

/* Switches the inclusions and surface effects of ice back on. Keeps the settings that --set and
 * --preset have made. Cracks are drawn as gaps, because the path tracer draws them as gaps. */
void option_ladder_whole(struct setup_scene *scene);

/* Returns the first EXR output, or NULL. --keep-sums stores the sample sums beside this file. */
const char *option_sums_image(const struct app_options *options);

/* Returns the file name of an image's sample sums: "a.sums.exr" for "a.exr". The caller frees the
 * name. If out of memory, returns NULL. */
char *option_sums_file(const char *image);

/* If options of the path tracer are given without --refraction reference, logs an error and returns
 * STATUS_USAGE. Sets the default sample count and pixel filter. */
MUST_USE enum status option_check_reference(struct app_options *options);

#endif
