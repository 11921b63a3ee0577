/* comparison_image.h: still image shown in an A/B comparison. It is an image file, a path-traced
 * image or an error map. All functions log their errors. */
#ifndef FIRN_VIEW_COMPARE_COMPARISON_IMAGE_H
#define FIRN_VIEW_COMPARE_COMPARISON_IMAGE_H

#include "shaders/output/tonemap.h"
#include "src/file/image.h"
#include "src/gpu/gpu.h"

struct comparison_image {
    struct image linear;       /* planes RGB; width 0 if none */
    bool is_tone_mapped;       /* already tone-mapped, like PNG files */
    struct gpu_image image;    /* displayed pixels; {0} if not uploaded */
    struct gpu_image previous; /* previous image, perhaps still in use */
    bool is_current;           /* `image` is up to date */
    struct tonemap_params tonemap;
};

/* If `image` is outdated, tone-maps `linear` with tonemap_encode() and uploads the result. */
MUST_USE enum status comparison_image_show(struct comparison_image *s, struct gpu *gpu,
                                           const struct tonemap_params *tonemap);

/* Uploads sRGB-encoded pixels to `image` if it is outdated. */
MUST_USE enum status comparison_image_upload(struct comparison_image *s, struct gpu *gpu,
                                             const uint8_t *rgba, VkExtent2D size);

void comparison_image_leave_device(struct comparison_image *s, struct gpu *gpu);

#endif
