/*
 * environment.h: an equirectangular picture of the surroundings at infinity.
 *
 * -Z in the middle, +Y at the top, +X right of the middle; linear Rec.709 radiance.
 */
#ifndef FIRN_SCENE_ENVIRONMENT_H
#define FIRN_SCENE_ENVIRONMENT_H

#include <stdint.h>
#include "src/status.h"

struct environment {
    uint16_t *texels; /* half RGBA, rows from the top; finite, not negative; alpha 1 */
    uint32_t width, height;
};

/*
 * Loads a .exr (channels R, G, B or Y) or .hdr file. Values that are not finite become 0, those
 * below 0 too, those beyond half's range its largest. Logs and returns STATUS_NO_INPUT,
 * STATUS_DATA or STATUS_TRY_AGAIN; *environment is then {0}.
 */
MUST_USE enum status environment_load(struct environment *environment, const char *path);

void environment_finish(struct environment *environment);

#endif
