/* panorama.h: pictures of a cube's faces as equirectangular ones. */
#ifndef FIRN_SCENE_PANORAMA_H
#define FIRN_SCENE_PANORAMA_H

#include <stdbool.h>
#include "src/base/status.h"
#include "src/image/image.h"

enum panorama {
    PANORAMA_NONE,      /* no cube */
    PANORAMA_OPENEXR,   /* faces one below the other, as OpenEXR's attribute `envmap` means them */
    PANORAMA_ROW,       /* +X -X +Y -Y +Z -Z in Vulkan's orientation, one beside the other */
    PANORAMA_CROSS,     /* 4:3: left, front (-Z), right, back; up and down above and below front */
    PANORAMA_TALL_CROSS /* 3:4: back is below down, upside down */
};

/* Returns what the shape of a picture says; a cross must be black beside its faces, so that an
 * ordinary picture is none. */
enum panorama panorama_find(const struct image *image);

/*
 * Replaces the planes of a cube with those of an equirectangular picture, four faces wide, at most
 * 8192 texels: -Z in the middle, +X right of it, each texel the mean of four bilinear lookups.
 * Returns STATUS_OK, or logs with `path` and returns STATUS_TRY_AGAIN; the picture is then as it
 * was.
 */
MUST_USE enum status panorama_unfold(struct image *image, enum panorama kind, const char *path);

#endif
