/* farm_script.h: writes sh scripts that submit a sequence of frames to Slurm or GNU parallel. Each
 * task runs firn render --resume --chunk K/N. A repeated task draws only the missing frames. */
#ifndef FIRN_APP_FARM_SCRIPT_H
#define FIRN_APP_FARM_SCRIPT_H

#include <stdio.h>
#include "src/app/app.h"

struct farm_script {
    const struct app_options *options;
    uint32_t frame_count;
    uint32_t task_count; /* 1 to frame_count */
    const char *program; /* path of firn */
    const char *name;    /* job name, letters and digits */
};

typedef void farm_script_fn(const struct farm_script *script, FILE *out);

farm_script_fn farm_script_slurm, farm_script_parallel;

#endif
