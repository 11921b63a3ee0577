/* hdr.h: reads Radiance .hdr files with stb_image into planes R, G, B. */
#ifndef FIRN_FILE_HDR_H
#define FIRN_FILE_HDR_H

#include "src/base/status.h"
#include "src/file/image.h"
#include "src/file/image_metadata.h"

/* Reads only the header, and returns the size and planes that hdr_read() would return. */
MUST_USE enum status hdr_read_header(const char *path, struct image_header *head);

/* Reads a Radiance file. *image must be {0}. Limits and errors are those of exr_read(). */
MUST_USE enum status hdr_read(const char *path, struct image *image);

#endif
