/* environment_image.h: reads the image file of an environment: colour channels and windows. */
#ifndef FIRN_SCENE_ENVIRONMENT_ENVIRONMENT_IMAGE_H
#define FIRN_SCENE_ENVIRONMENT_ENVIRONMENT_IMAGE_H

#include <stdbool.h>
#include <stdint.h>
#include "src/base/status.h"
#include "src/file/image.h"

struct environment_image {
    /* Planes R, G and B in linear Rec.709, or Y; and A of a strip of cube faces. Values are finite,
     * and not negative unless the file has other primaries. */
    struct image image;
    struct image_header head; /* of an EXR file, else {0} */
};

/* Reads an .exr or .hdr file. Logs and returns STATUS_NO_INPUT, STATUS_DATA or STATUS_TRY_AGAIN;
 * *read is then zeroed. */
MUST_USE enum status environment_image_read(struct environment_image *read, const char *path);

void environment_image_finish(struct environment_image *read);

/* Returns the window of an EXR file that all directions are mapped to: the display window or, if
 * `envmap` is set and the data window has the shape that it names, the data window. Other files
 * have no windows: returns the whole image. */
struct image_box environment_image_frame(const struct image_header *head);

/* Returns true if an image has aspect 2:1, or is at least 16 texels high and misses it by one row
 * or up to two columns. */
bool environment_image_is_equirect(uint64_t width, uint64_t height);

#endif
