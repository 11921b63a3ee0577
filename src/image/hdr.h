/* hdr.h: reads Radiance .hdr files, by stb_image, into planes R, G, B. */
#ifndef FIRN_IMAGE_HDR_H
#define FIRN_IMAGE_HDR_H

#include "src/base/status.h"
#include "src/image/image.h"

/* Reads a file. Limits, errors and ownership are those of exr_read(). Other formats of stb_image
 * are refused. */
MUST_USE enum status hdr_read(const char *path, struct image *image);

#endif
