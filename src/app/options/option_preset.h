/* option_preset.h: the settings of --preset. */
#ifndef FIRN_APP_OPTIONS_OPTION_PRESET_H
#define FIRN_APP_OPTIONS_OPTION_PRESET_H

#include "src/app/app.h"

/* Reads the scene's preset, if it has one, and sets what no --set has set. Logs: STATUS_DATA, and
 * the statuses of reader.h. */
MUST_USE enum status option_preset_read(struct app_scene *scene);

#endif
