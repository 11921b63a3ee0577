/* preset_option.h: applies the settings of --preset. */
#ifndef FIRN_APP_OPTIONS_PRESET_OPTION_H
#define FIRN_APP_OPTIONS_PRESET_OPTION_H

#include "src/app/app.h"

/* Reads the preset that the options name, if any, and applies it. Values of --set are kept. On
 * failure logs and returns STATUS_DATA or a status of reader_process.h. */
MUST_USE enum status option_preset_read(struct app_scene *scene);

#endif
