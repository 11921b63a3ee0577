/* input.h: pictures and masks that options name. All log what is wrong. */
#ifndef FIRN_APP_INPUT_H
#define FIRN_APP_INPUT_H

#include "src/base/status.h"
#include "src/image/image.h"
#include "src/reader/reader.h"

/* An EXR, HDR or PNG file into *image ({0} before), as picture_read() says; else STATUS_USAGE. */
MUST_USE enum status input_read(const char *path, const struct reader_params *params,
                                struct image *image);

/* Whether both have the same size, else STATUS_DATA; the paths are for the words. */
MUST_USE enum status input_check_size(const struct image *image, const char *path,
                                      const struct image *other, const char *other_path);

/* *counted gets, for each pixel, whether the channel is above 0; the caller frees it. STATUS_DATA
 * if it is not there, or above 0 nowhere; STATUS_TRY_AGAIN. */
MUST_USE enum status input_make_mask(const struct image *image, const char *path,
                                     const char *channel, bool **counted);

#endif
