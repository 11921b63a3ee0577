/* input_image.h: reads input images and masks that options name. All functions log errors. */
#ifndef FIRN_APP_INPUT_IMAGE_H
#define FIRN_APP_INPUT_IMAGE_H

#include "src/base/status.h"
#include "src/file/image.h"
#include "src/file/reader_process.h"

/* Reads an EXR, HDR or PNG file into *image, which must be {0}. If the file name has another
 * suffix, returns STATUS_USAGE. Otherwise returns the status of image_reader_read(). */
MUST_USE enum status input_image_read(const char *path, const struct reader_params *params,
                                      struct image *image);

/* Checks that two images have the same size. If not, logs both paths and returns STATUS_DATA. */
MUST_USE enum status input_image_check_size(const struct image *image, const char *path,
                                            const struct image *other, const char *other_path);

/* Sets *counted to a mask, which the caller frees. The mask is true for pixels whose `channel` is
 * above 0. If there are none, returns STATUS_DATA. If out of memory, returns STATUS_TRY_AGAIN. */
MUST_USE enum status input_image_make_mask(const struct image *image, const char *path,
                                           const char *channel, bool **counted);

#endif
