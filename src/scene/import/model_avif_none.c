/* model_avif_none.c: stubs for builds without libavif. */
#include "src/scene/import/model_avif.h"

/* NOLINTBEGIN(readability-non-const-parameter): the other implementation writes to them */

bool model_avif_is_built(void)
{
    return false;
}

bool model_avif_read_size(const uint8_t *bytes, size_t size, int *width, int *height)
{
    (void)bytes, (void)size, (void)width, (void)height;
    return false;
}

enum status model_avif_decode(const uint8_t *bytes, size_t size, int width, int height,
                              uint8_t *texels)
{
    (void)bytes, (void)size, (void)width, (void)height, (void)texels;
    return STATUS_DATA;
}

/* NOLINTEND(readability-non-const-parameter) */
