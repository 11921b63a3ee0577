/* hdr.h: reads Radiance .hdr files with stb_image into planes R, G, B. */
#ifndef FIRN_FILE_HDR_H
#define FIRN_FILE_HDR_H

#include "src/base/status.h"
#include "src/file/image.h"

/* Reads a Radiance file. *image must be {0}; `begin` may be NULL. Limits and errors are those of
 * exr_read(). */
MUST_USE enum status hdr_read(const char *path, struct image *image, image_size_fn *begin,
                              void *user);

#endif
