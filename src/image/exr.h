/*
 * exr.h: OpenEXR files, by the Core C API.
 *
 * Written: one part, scan lines, ZIP, channels sorted by name, half or float as the plane says;
 * no time of day, so that the same picture gives the same bytes. Read: the first part, scan
 * lines or tiles (level 0), channels of any of the three pixel types.
 */
#ifndef FIRN_IMAGE_EXR_H
#define FIRN_IMAGE_EXR_H

#include "src/image/image.h"
#include "src/status.h"

struct exr_header {
    const struct image_text *texts; /* string attributes; may be NULL if text_count is 0 */
    uint32_t text_count;
    const float *world_to_camera; /* 16 floats, EXR's row-vector order; may be NULL */
    const float *world_to_ndc;    /* the same; may be NULL */
};

/*
 * Encodes an image into memory: *data (malloc'd, the caller frees it), *size bytes. Rec.709
 * chromaticities are always written. Values beyond half's range, infinities among them, are clamped
 * to +-65504 in half planes; NaN stays NaN and float planes are kept as they are. The image has at
 * least one plane. Logs and returns STATUS_TRY_AGAIN (memory) or STATUS_FAILED; *data is then NULL.
 */
MUST_USE enum status exr_encode(const struct image *image, const struct exr_header *header,
                                void **data, size_t *size);

/*
 * Reads a file into *image ({0} before): the data window of its first part, channels in the file's
 * order, texels that are not finite as they are. The limits of image.h are checked before anything
 * is allocated. Not read, STATUS_DATA: deep data, subsampled channels, DWAA and DWAB. Logs and
 * returns STATUS_NO_INPUT, STATUS_DATA or STATUS_TRY_AGAIN; *image is then {0}.
 */
MUST_USE enum status exr_read(const char *path, struct image *image);

/*
 * Whether a file is such as exr_encode() makes of an image of this size and these planes, with
 * these texts in its header among others, and can be read to its end. Texels (which may be NULL)
 * and matrices are not compared. Logs only when the file is missing or cannot be opened.
 */
bool exr_matches(const char *path, const struct image *image, const struct exr_header *header);

/*
 * Reads a file to its end. *text: a text of its header, "" if there is none of that name; the
 * caller frees it. Limits and errors as exr_read(); *text is then NULL.
 */
MUST_USE enum status exr_inspect(const char *path, const char *name, char **text);

#endif
