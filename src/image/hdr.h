/* hdr.h: Radiance .hdr files, by stb_image, into planes R, G, B. */
#ifndef FIRN_IMAGE_HDR_H
#define FIRN_IMAGE_HDR_H

#include "src/base/status.h"
#include "src/image/image.h"

/* Limits, errors and ownership as exr_read(). The other formats stb_image knows are refused. */
MUST_USE enum status hdr_read(const char *path, struct image *image);

#endif
