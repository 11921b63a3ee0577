/* fuzz_image.h: what the readers of pictures share. */
#ifndef TESTS_FUZZ_IMAGE_H
#define TESTS_FUZZ_IMAGE_H

#include "src/base/status.h"
#include "src/file/image.h"
#include "tests/fuzz/fuzz.h"

/* Aborts unless the image is within the limits of readers, or {0} where it was refused. */
static inline void fuzz_check_image(const struct image *image, enum status status)
{
    FUZZ_CHECK(status == STATUS_OK || status == STATUS_DATA);
    if (status != STATUS_OK) {
        FUZZ_CHECK(image->width == 0 && image->height == 0 && image->plane_count == 0 &&
                   !image->planes);
        return;
    }
    FUZZ_CHECK(image->width >= 1 && image->width <= IMAGE_MAX_SIDE);
    FUZZ_CHECK(image->height >= 1 && image->height <= IMAGE_MAX_SIDE);
    FUZZ_CHECK(image->plane_count >= 1 && image->plane_count <= IMAGE_MAX_PLANES);
    for (uint32_t p = 0; p < image->plane_count; p++) {
        FUZZ_CHECK(memchr(image->planes[p].name, 0, IMAGE_NAME_SIZE));
        FUZZ_CHECK(image->planes[p].texels);
    }
}

#endif
