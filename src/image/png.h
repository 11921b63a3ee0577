/* png.h: reads and writes PNG files by libpng: sRGB of 8 or 16 bits, for displays. */
#ifndef FIRN_IMAGE_PNG_H
#define FIRN_IMAGE_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/base/status.h"
#include "src/image/image.h"
#include "src/image/picture_head.h"

struct png_picture {
    const uint8_t *rgba;            /* sRGB-encoded texels, rows from the top */
    uint32_t width, height;         /* pixels */
    const struct image_text *texts; /* may be NULL if text_count is 0 */
    uint32_t text_count;
    const uint16_t *rgba_16; /* texels of 16 bits, in place of rgba; NULL: 8 bits */
    bool has_alpha;          /* not opaque: texels are not multiplied by it */
};

/*
 * Encodes a picture as RGB, or as RGBA if it has alpha, into memory: *data (malloc'd, the caller
 * frees it), *size bytes. Writes an sRGB chunk and the texts (tEXt if they are ASCII, else iTXt in
 * UTF-8; names of at most 79 characters), but no time of day. Logs and returns STATUS_TRY_AGAIN or
 * STATUS_FAILED; *data is then NULL.
 */
MUST_USE enum status png_encode(const struct png_picture *picture, void **data, size_t *size);

/*
 * Reads a PNG file of any kind into *image, which must be {0}: planes R, G and B, and A if it has
 * alpha or a transparent colour. Colours are decoded to linear ones and not multiplied by alpha. 16
 * bits are rounded to 8; files without a colour space are taken as sRGB. Limits, errors and
 * ownership are those of exr_read().
 */
MUST_USE enum status png_read(const char *path, struct image *image);

/* Returns size and planes that png_read() would give, from the file's beginning. */
MUST_USE enum status png_head(const char *path, struct picture_head *head);

/* Checks a whole file by the checksums of its chunks, without unpacking its texels, and returns
 * what it says in *head, which the caller finishes. Errors are those of png_read(). */
MUST_USE enum status png_check(const char *path, struct picture_head *head);

/* Returns whether a head is that of the picture: its size, its colours, with alpha if it has one,
 * and its texts. Texels (which may be NULL) are not compared. */
bool png_matches(const struct picture_head *head, const struct png_picture *picture);

#endif
