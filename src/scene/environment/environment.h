/*
 * environment.h: loads environment images in linear Rec.709 radiance. An equirectangular image is
 * infinitely far away: -Z is in the centre, +Y at the top, and +X right of the centre. A captured
 * cube is a column of six faces, ordered and oriented as in Vulkan: +X -X +Y -Y +Z -Z.
 */
#ifndef FIRN_SCENE_ENVIRONMENT_ENVIRONMENT_H
#define FIRN_SCENE_ENVIRONMENT_ENVIRONMENT_H

#include <cglm/types-struct.h>
#include <stdbool.h>
#include <stdint.h>
#include "src/base/status.h"

/* Sun of an equirectangular environment. The disc of the sun is not part of the image. */
struct environment_sun {
    vec3s dir;   /* unit direction to the sun, not yet rotated by environment.turn */
    vec3s light; /* radiance of a white diffuse surface facing the sun; 0 without a sun */
};

struct environment {
    uint16_t *texels;       /* half RGBA texels, top row first; finite and not negative; owned */
    uint32_t width, height; /* texels */
    float turn;             /* rotation about +Y of an equirectangular image, in turns, 0 to 1 */
    struct environment_sun sun;
    bool is_cube; /* true for a captured cube, whose alpha is 1 / (distance in metres) */
};

/* Loads an .exr file (channels R, G, B or Y; a captured cube also needs A, without which everything
 * is at infinity) or a .hdr file. An image with aspect 1:6 is a captured cube, unless its attribute
 * `envmap` declares a cube map; such maps, and the other cube layouts of cube_to_equirect.h, are
 * converted to equirectangular images. All others must have aspect 2:1 within a texel. Colours with
 * other chromaticities are converted to Rec.709, and white stays white. Negative and non-finite
 * values become 0, which a note counts, and values beyond half's range its maximum. Logs and
 * returns STATUS_NO_INPUT, STATUS_DATA or STATUS_TRY_AGAIN; *environment is then zeroed. */
MUST_USE enum status environment_load(struct environment *environment, const char *path);

#define ENVIRONMENT_SUN_MAX 1e6f /* limit of environment_sun.light in files */

/* Returns a unit direction. Angles are in degrees; azimuth 0 is +Z, and 90 is +X. */
vec3s environment_direction(float azimuth_deg, float elevation_deg);

/* EXR string attribute that stores the sun as "AZIMUTH ELEVATION RED GREEN BLUE". The angles are
 * sky.sun_azimuth and sky.sun_elevation in degrees. The colour is environment_sun.light. */
#define ENVIRONMENT_SUN_TEXT "firn/sun"

/* Multiplies all radiances, the sun's included, by 2^stops. */
void environment_apply_exposure(struct environment *environment, float stops);

/* Frees the texels; *environment is then zeroed. */
void environment_finish(struct environment *environment);

#endif
