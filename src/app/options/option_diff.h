/* option_diff.h: what the options of firn diff set; values are as on the command line. */
#ifndef FIRN_APP_OPTIONS_OPTION_DIFF_H
#define FIRN_APP_OPTIONS_OPTION_DIFF_H

#include "src/app/app.h"

/* Each logs what is wrong: STATUS_USAGE. */
enum status option_mask(struct app_options *o, const char *value);
enum status option_mask_channel(struct app_options *o, const char *value);
enum status option_exposure(struct app_options *o, const char *value);
enum status option_curve(struct app_options *o, const char *value);
enum status option_ppd(struct app_options *o, const char *value);
enum status option_error_picture(struct app_options *o, const char *value);
enum status option_fail_above(struct app_options *o, const char *value);

#endif
