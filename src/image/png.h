/* png.h: PNG files, by libpng: 8-bit sRGB, for people's eyes. */
#ifndef FIRN_IMAGE_PNG_H
#define FIRN_IMAGE_PNG_H

#include <stddef.h>
#include <stdint.h>
#include "src/status.h"

/*
 * Encodes width x height RGBA texels (sRGB-encoded, rows from the top) as opaque RGB into memory:
 * *data (malloc'd, the caller frees it), *size bytes. Writes an sRGB chunk, no time of day. Logs
 * and returns STATUS_TRY_AGAIN or STATUS_FAILED; *data is then NULL.
 */
MUST_USE enum status png_encode(const uint8_t *rgba, uint32_t width, uint32_t height, void **data,
                                size_t *size);

#endif
