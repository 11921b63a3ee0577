/* hdr.h: reads Radiance .hdr files, by stb_image, into planes R, G, B. */
#ifndef FIRN_IMAGE_HDR_H
#define FIRN_IMAGE_HDR_H

#include "src/base/status.h"
#include "src/image/image.h"
#include "src/image/picture_head.h"

/* Returns size and planes that hdr_read() would give, from the file's beginning. */
MUST_USE enum status hdr_head(const char *path, struct picture_head *head);

/* Reads a file. Limits, errors and ownership are those of exr_read(). Other formats of stb_image
 * are refused. */
MUST_USE enum status hdr_read(const char *path, struct image *image);

#endif
