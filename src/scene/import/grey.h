/* grey.h: the greys of a picture, as a square. */
#ifndef FIRN_SCENE_IMPORT_GREY_H
#define FIRN_SCENE_IMPORT_GREY_H

#include "src/base/status.h"
#include "src/reader/reader.h"

/*
 * Reads an .exr, .hdr or .png in a reader process (reader.h, with its errors), and resamples the
 * mean of its red, green and blue, or its only channel, to `side` x `side` texels, the top row
 * first; edges continue on the other side. Greys of .png files are as they are stored, 0 to 1;
 * others are limited to 0 to 1 if `is_share`. The caller frees *greys. A picture without such
 * channels, or with numbers beyond -65504 to 65504, is STATUS_DATA.
 */
MUST_USE enum status grey_read(float **greys, uint32_t side, bool is_share, const char *path,
                               const struct reader_params *params);

#endif
