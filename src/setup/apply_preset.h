/* apply_preset.h: applies the settings of --preset. */
#ifndef FIRN_SETUP_APPLY_PRESET_H
#define FIRN_SETUP_APPLY_PRESET_H

#include "src/setup/setup.h"

/* Applies the preset that the options name, if any. Keeps values given by --set. On failure, logs
 * an error and returns STATUS_DATA or a status of reader_process.h. */
MUST_USE enum status setup_apply_preset(struct setup_scene *scene);

#endif
