/* png.h: reads and writes PNG files by libpng: 8-bit sRGB, for displays. */
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
 * Writes an sRGB chunk and the texts (tEXt if they are ASCII, else iTXt in UTF-8; names of at most
 * 79 characters), but no time of day. Logs and returns STATUS_TRY_AGAIN or STATUS_FAILED; *data is
 * then NULL.
 */
MUST_USE enum status png_encode(const struct png_picture *picture, void **data, size_t *size);

/*
 * Reads a PNG file of any kind into *image, which must be {0}: planes R, G and B, and A if it has
 * alpha or a transparent colour. Colours are decoded to linear ones and not multiplied by alpha. 16
 * bits are rounded to 8; files without a colour space are taken as sRGB. Limits, errors and
 * ownership are those of exr_read().
 */
MUST_USE enum status png_read(const char *path, struct image *image);

/*
 * Returns whether a file is complete and has the format of png_encode(), the picture's size and
 * texts, and right checksums of all chunks. Texels (which may be NULL) are not compared. Logs only
 * if the file is missing or cannot be opened.
 */
bool png_matches(const char *path, const struct png_picture *picture);

/* Checks a file by the checksums of all chunks, and returns a text as exr_inspect() does. */
MUST_USE enum status png_inspect(const char *path, const char *name, char **text);

#endif
