/*
 * still.h: a picture that does not follow the camera: of a file, or traced for one view.
 *
 * Errors: logged once where found.
 */
#ifndef FIRN_VIEW_STILL_H
#define FIRN_VIEW_STILL_H

#include "src/gpu/gpu.h"
#include "src/image/image.h"

struct still {
    struct image linear;     /* planes R, G and B; width 0: nothing */
    bool is_shown;           /* they are tonemapped, as those of PNG files */
    struct gpu_image image;  /* as it is shown; {0}: not made yet, or not any more */
    struct gpu_image former; /* the one before, which a window may still know */
    bool is_made;            /* `image` is that of `linear`, with: */
    float gain;
    uint32_t curve;
};

/* Makes `image`, unless it is there. `gain` and `curve`: tonemap_encode(). */
MUST_USE enum status still_show(struct still *still, struct gpu *gpu, float gain, uint32_t curve);

/* Makes `image` of sRGB-encoded pixels, unless it is there. */
MUST_USE enum status still_put(struct still *still, struct gpu *gpu, const uint8_t *rgba,
                               VkExtent2D size);

void still_leave_device(struct still *still, struct gpu *gpu);
void still_finish(struct still *still, struct gpu *gpu); /* {0} is fine */

#endif
