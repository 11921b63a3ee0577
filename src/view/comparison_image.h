/*
 * comparison_image.h: an image to compare with that does not follow the camera: from a file, or
 * path-traced.
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_COMPARISON_IMAGE_H
#define FIRN_VIEW_COMPARISON_IMAGE_H

#include "src/gpu/gpu.h"
#include "src/image/image.h"

struct comparison_image {
    struct image linear;     /* planes R, G and B; width 0 if there is none */
    bool is_shown;           /* planes are tone-mapped already, like those of PNG files */
    struct gpu_image image;  /* displayed pixels; {0} if not uploaded */
    struct gpu_image former; /* previous image, which a window's plan may still refer to */
    bool is_made;            /* `image` shows `linear` with `gain` and `curve` */
    float gain;
    uint32_t curve;
};

/* Encodes and uploads `image` unless it is up to date. `gain` and `curve` are those of
 * tonemap_encode(). */
MUST_USE enum status comparison_image_show(struct comparison_image *still, struct gpu *gpu,
                                           float gain, uint32_t curve);

/* Uploads sRGB-encoded pixels to `image` unless it is up to date. */
MUST_USE enum status comparison_image_upload(struct comparison_image *still, struct gpu *gpu,
                                             const uint8_t *rgba, VkExtent2D size);

void comparison_image_leave_device(struct comparison_image *still, struct gpu *gpu);
void comparison_image_finish(struct comparison_image *still, struct gpu *gpu); /* {0} is fine */

#endif
