/* cube_to_equirect.h: detects cube map layouts, and converts them to equirectangular images. */
#ifndef FIRN_SCENE_ENVIRONMENT_CUBE_TO_EQUIRECT_H
#define FIRN_SCENE_ENVIRONMENT_CUBE_TO_EQUIRECT_H

#include <stdbool.h>
#include "src/base/status.h"
#include "src/file/image.h"

enum panorama {
    PANORAMA_NONE,    /* not a cube map */
    PANORAMA_OPENEXR, /* vertical strip with OpenEXR's attribute `envmap` */
    PANORAMA_ROW,     /* horizontal strip +X -X +Y -Y +Z -Z in Vulkan's orientation */
    /* 4:3 cross: a row of left, front (-Z), right and back faces, with up and down next to front */
    PANORAMA_CROSS,
    PANORAMA_TALL_CROSS /* 3:4 cross; the back face is the lowest, and upside down */
};

/* Returns the cube map layout of an image, by aspect ratio. A cross must also be black outside the
 * faces, because an ordinary image may have a cross's aspect ratio. */
enum panorama panorama_detect_cube(const struct image *image);

/* Converts a cube map to an equirectangular image (-Z in the centre, +X right of the centre). The
 * new width is four faces, at most 8192 texels. Each texel is the mean of four bilinear samples. If
 * out of memory, logs `path`, keeps the image, and returns STATUS_TRY_AGAIN. */
MUST_USE enum status panorama_from_cube(struct image *image, enum panorama kind, const char *path);

#endif
