/* png.c: PNG files by libpng's simplified interface, which needs no setjmp of ours. */
#include "src/image/png.h"
#include <png.h>
#include <stdlib.h>
#include "src/image/image.h"
#include "src/log.h"

enum status png_encode(const uint8_t *rgba, uint32_t width, uint32_t height, void **data,
                       size_t *size)
{
    const size_t texel_count = (size_t)width * height;
    png_image png = { .version = PNG_IMAGE_VERSION };
    uint8_t *rgb = NULL;
    void *bytes = NULL;
    enum status status = STATUS_TRY_AGAIN;

    *data = NULL;
    *size = 0;
    if (width == 0 || height == 0 || height > IMAGE_MAX_TEXELS / width) {
        log_error("a PNG picture cannot have %u x %u pixels", width, height);
        return STATUS_FAILED;
    }
    png.width = width;
    png.height = height;
    png.format = PNG_FORMAT_RGB; /* 8 bits a channel: taken as sRGB, and marked so */
    png_alloc_size_t bytes_size = PNG_IMAGE_PNG_SIZE_MAX(png);

    rgb = malloc(texel_count * 3);
    bytes = malloc(bytes_size);
    if (!rgb || !bytes) {
        log_error("out of memory for a PNG picture of %u x %u pixels", width, height);
        goto fail;
    }
    for (size_t i = 0; i < texel_count; i++) {
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = rgba[4 * i + c];
    }
    if (!png_image_write_to_memory(&png, bytes, &bytes_size, 0, rgb, 0, NULL)) {
        log_error("a PNG picture could not be encoded: %s", png.message);
        status = STATUS_FAILED;
        goto fail;
    }
    free(rgb);
    *data = bytes;
    *size = bytes_size;
    return STATUS_OK;

fail:
    free(rgb);
    free(bytes);
    return status;
}
