/* preset_option.h: applies the settings of --preset. */
#ifndef FIRN_APP_OPTIONS_PRESET_OPTION_H
#define FIRN_APP_OPTIONS_PRESET_OPTION_H

#include "src/app/app.h"

/* Reads the scene's preset, if any, and applies its settings, except those that --set has set. Logs
 * errors and returns STATUS_DATA or a status of reader_process.h. */
MUST_USE enum status option_preset_read(struct app_scene *scene);

#endif
