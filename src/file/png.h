/* png.h: reads and writes PNG files with libpng: sRGB-encoded, 8 or 16 bits per channel. */
#ifndef FIRN_FILE_PNG_H
#define FIRN_FILE_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include "src/base/status.h"
#include "src/file/image.h"

struct png_image_source {
    const uint8_t *rgba;            /* sRGB-encoded, rows from the top */
    uint32_t width, height;         /* pixels */
    const struct image_text *texts; /* metadata; NULL if text_count is 0 */
    uint32_t text_count;
    const uint16_t *rgba_16; /* used instead of rgba unless NULL */
    bool has_alpha;          /* write alpha; colours are not premultiplied */
};

/*
 * Encodes an image as RGB, or RGBA if it has alpha, into memory: *data (malloc'd, freed by the
 * caller) of *size bytes. Writes an sRGB chunk and the texts (ASCII as tEXt, else iTXt in UTF-8;
 * names of at most 79 characters), but no timestamp. On failure logs, sets *data to NULL and
 * returns STATUS_TRY_AGAIN or STATUS_FAILED.
 */
MUST_USE enum status png_encode(const struct png_image_source *picture, void **data, size_t *size);

/*
 * Reads a PNG file of any colour type into *image, which must be {0}. The planes are R, G, B and,
 * if the file has alpha or a transparent colour, A. Colours become linear and are not
 * premultiplied. 16-bit channels are rounded to 8 bits. Files without a colour space are taken as
 * sRGB. `begin` may be NULL. Limits and errors are those of exr_read().
 */
MUST_USE enum status png_read(const char *path, struct image *image, image_size_fn *begin,
                              void *user);

/* Returns false if a chunk of a PNG file ends after the file. libpng might allocate and clear 2 GiB
 * for it. Returns true for other files. Leaves the position at the start. */
bool png_has_whole_chunks(FILE *file, int64_t size);

/* Checks a file by decoding it and comparing all CRCs. Reads the header into *head, which the
 * caller frees. png_read() describes the errors. */
MUST_USE enum status png_check(const char *path, struct image_header *head);

/* Returns true if `head` has the size, channels and texts that png_encode() would write for the
 * image. Texels are not compared, so they may be NULL. */
bool png_matches(const struct image_header *head, const struct png_image_source *picture);

#endif
