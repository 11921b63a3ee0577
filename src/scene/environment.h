/*
 * environment.h: a picture of the surroundings; linear Rec.709 radiance.
 *
 * Equirectangular, at infinity: -Z in the middle, +Y at the top, +X right of the middle. Or a cube:
 * six square faces, one below the other, +X -X +Y -Y +Z -Z, each as Vulkan turns it.
 */
#ifndef FIRN_SCENE_ENVIRONMENT_H
#define FIRN_SCENE_ENVIRONMENT_H

#include <stdbool.h>
#include <stdint.h>
#include "src/base/status.h"

struct environment {
    uint16_t *texels; /* half RGBA, rows from the top; finite, not negative; alpha 1, or ... */
    uint32_t width, height;
    bool is_cube; /* ... 1 / distance from where it was captured, 1 / metre; 0: infinitely far */
};

/*
 * Loads a .exr (channels R, G, B or Y; of a cube A, too, else all is infinitely far away) or .hdr
 * file. A picture six times as high as wide is a cube; another that is higher than wide is refused.
 * Values that are not finite become 0, those below 0 too, those beyond half's range its largest.
 * Logs and returns STATUS_NO_INPUT, STATUS_DATA or STATUS_TRY_AGAIN; *environment is then {0}.
 */
MUST_USE enum status environment_load(struct environment *environment, const char *path);

void environment_finish(struct environment *environment);

#endif
