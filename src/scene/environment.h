/*
 * environment.h: an image of the surroundings in linear Rec.709 radiance.
 *
 * It is either equirectangular and infinitely far away, with -Z in the middle, +Y at the top and +X
 * right of the middle; or a cube, six square faces, one below the other, +X -X +Y -Y +Z -Z, in
 * Vulkan's orientation.
 */
#ifndef FIRN_SCENE_ENVIRONMENT_H
#define FIRN_SCENE_ENVIRONMENT_H

#include <cglm/types-struct.h>
#include <stdbool.h>
#include <stdint.h>
#include "src/base/status.h"

/* The sun of a panorama, whose disc the picture does not show. */
struct environment_sun {
    vec3s dir;   /* unit, towards the sun, as the picture is stored: before `turn` */
    vec3s light; /* radiance of a matt white surface that faces it, by it alone; 0: no sun */
};

struct environment {
    uint16_t *texels;       /* half RGBA, rows from the top; finite, not negative; owned */
    uint32_t width, height; /* texels */
    float turn;             /* of an equirectangular picture: turns about +Y, 0 to 1 */
    struct environment_sun sun;
    bool is_cube; /* alpha is 1 / distance from the capture's centre, 1 / metre, 0 at infinity; if
                     false, alpha is 1 */
};

/*
 * Loads a .exr file (channels R, G, B or Y; of a cube also A, without which everything is
 * infinitely far away) or a .hdr file. An image six times as high as wide is a cube, but a panorama
 * if its attribute `envmap` says so; that, and other cubes of panorama.h, become equirectangular.
 * Others that are not twice as wide as high are refused. Colours of an .exr with other
 * chromaticities than those of Rec.709 are converted; white stays white. Values below 0 or not
 * finite become 0; values beyond half's range become its largest. Logs and returns STATUS_NO_INPUT,
 * STATUS_DATA or STATUS_TRY_AGAIN; *environment is then {0}.
 */
MUST_USE enum status environment_load(struct environment *environment, const char *path);

#define ENVIRONMENT_SUN_MAX 1e6f /* environment_sun.light of a file */

/* Returns the unit direction of an azimuth (0 is +Z, 90 is +X) and an elevation above the horizon,
 * degrees. */
vec3s environment_direction(float azimuth_deg, float elevation_deg);

/* The text of an .exr file that names its sun: "AZIMUTH ELEVATION RED GREEN BLUE", degrees as those
 * of sky.sun_azimuth and sky.sun_elevation, and environment_sun.light. */
#define ENVIRONMENT_SUN_TEXT "firn/sun"

/* Multiplies the colours by 2^stops. */
void environment_expose(struct environment *environment, float stops);

/* Frees the texels; *environment is then {0}. */
void environment_finish(struct environment *environment);

#endif
