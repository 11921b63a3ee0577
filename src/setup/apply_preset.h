/* apply_preset.h: applies the settings of --preset. */
#ifndef FIRN_SETUP_APPLY_PRESET_H
#define FIRN_SETUP_APPLY_PRESET_H

#include "src/setup/setup.h"

/* Reads the preset that the options name, if any, and applies it. Values of --set are kept. On
 * failure logs and returns STATUS_DATA or a status of reader_process.h. */
MUST_USE enum status setup_apply_preset(struct setup_scene *scene);

#endif
