/* greyscale_map.h: loads an image file as a square greyscale map. */
#ifndef FIRN_SCENE_IMPORT_GREYSCALE_MAP_H
#define FIRN_SCENE_IMPORT_GREYSCALE_MAP_H

#include "src/base/status.h"
#include "src/file/reader_process.h"

/* Reads an .exr, .hdr or .png file in a reader process (reader_process.h, with its errors) and
 * resamples the mean of red, green and blue, or the only channel, to `side` x `side` texels, top
 * row first, with repeat wrapping. Values of .png files are as stored, 0 to 1, without sRGB
 * decoding; others are clamped to 0 to 1 if `is_unit_range`. The caller frees *greys. Returns
 * STATUS_DATA for an image without such channels, or with values beyond -65504 to 65504. */
MUST_USE enum status greyscale_map_read(float **greys, uint32_t side, bool is_unit_range,
                                        const char *path, const struct reader_params *params);

#endif
