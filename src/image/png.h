/* png.h: PNG files, by libpng: 8-bit sRGB, for people's eyes. */
#ifndef FIRN_IMAGE_PNG_H
#define FIRN_IMAGE_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/base/status.h"
#include "src/image/image.h"

struct png_picture {
    const uint8_t *rgba;            /* sRGB-encoded texels, rows from the top */
    uint32_t width, height;         /* pixels */
    const struct image_text *texts; /* may be NULL if text_count is 0 */
    uint32_t text_count;
};

/*
 * Encodes a picture as opaque RGB into memory: *data (malloc'd, the caller frees it), *size bytes.
 * Writes an sRGB chunk, the texts (tEXt where they are ASCII, else iTXt in UTF-8; names of at most
 * 79 characters), no time of day. Logs and returns STATUS_TRY_AGAIN or STATUS_FAILED; *data is
 * then NULL.
 */
MUST_USE enum status png_encode(const struct png_picture *picture, void **data, size_t *size);

/*
 * Reads a file of any kind of PNG into *image ({0} before): planes R, G and B, and A if it has
 * alpha or a transparent colour; colours are decoded to linear ones and not multiplied by alpha.
 * 16 bits are rounded to 8; without a word on colours in the file they are sRGB. Limits, errors
 * and ownership as exr_read().
 */
MUST_USE enum status png_read(const char *path, struct image *image);

/*
 * Whether a file is such as png_encode() makes of a picture of this size with these texts, whole,
 * and with the check sums of all its chunks right. Texels (which may be NULL) are not compared.
 * Logs only when the file is missing or cannot be opened.
 */
bool png_matches(const char *path, const struct png_picture *picture);

/* As exr_inspect(), by the check sums of all chunks. */
MUST_USE enum status png_inspect(const char *path, const char *name, char **text);

#endif
