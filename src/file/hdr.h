/* hdr.h: reads Radiance .hdr files into planes R, G, B of linear Rec.709. */
#ifndef FIRN_FILE_HDR_H
#define FIRN_FILE_HDR_H

#include "src/base/status.h"
#include "src/file/image.h"

/* Reads a Radiance file. Texels are divided by EXPOSURE and COLORCORR, each the product of all such
 * lines of the header. XYZE (of D65) and colours with other PRIMARIES are converted to Rec.709.
 * *image must be {0}; `begin` may be NULL. Limits and errors are those of exr_read(). */
MUST_USE enum status hdr_read(const char *path, struct image *image, image_size_fn *begin,
                              void *user);

#endif
