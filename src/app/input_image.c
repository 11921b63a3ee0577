/* input_image.c: reads input images and masks that options name. */
#include "src/app/input_image.h"
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/image_receive.h"

enum status input_image_read(const char *path, const struct reader_params *params,
                             struct image *image)
{
    if (image_reader_knows_suffix(path))
        return image_reader_read(image, path, params);
    log_error("expected a file name that ends in .exr, .hdr or .png, got '%s'", path);
    return STATUS_USAGE;
}

enum status input_image_check_size(const struct image *image, const char *path,
                                   const struct image *other, const char *other_path)
{
    if (other->width == image->width && other->height == image->height)
        return STATUS_OK;
    log_error("%s has %u x %u pixels, but %s has %u x %u: expected images of the same size",
              other_path, other->width, other->height, path, image->width, image->height);
    return STATUS_DATA;
}

enum status input_image_make_mask(const struct image *image, const char *path, const char *channel,
                                  bool **counted)
{
    const float *values = image_find(image, channel);
    const size_t count = (size_t)image->width * image->height;
    bool any = false;
    if (!values) {
        log_error("%s: expected a channel %s as the mask; choose another with --mask-channel", path,
                  channel);
        return STATUS_DATA;
    }
    *counted = malloc(count * sizeof(**counted));
    if (!*counted) {
        return log_out_of_memory(NULL);
    }
    for (size_t i = 0; i < count; i++) {
        (*counted)[i] = values[i] > 0.0f;
        any = any || (*counted)[i];
    }
    if (any)
        return STATUS_OK;
    log_error("%s: the mask selects no pixel: channel %s is nowhere above 0", path, channel);
    return STATUS_DATA;
}
