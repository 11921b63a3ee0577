/*
 * exr.h: OpenEXR files, by the Core C API.
 *
 * Written: one part, scan lines, ZIP, channels sorted by name, half or float as the plane says;
 * no time of day, so that the same picture gives the same bytes. Read: the first part, scan
 * lines or tiles (level 0), channels of any of the three pixel types.
 */
#ifndef FIRN_IMAGE_EXR_H
#define FIRN_IMAGE_EXR_H

#include "src/base/status.h"
#include "src/image/image.h"

/* Where an image lies in a larger picture: its data window in the display window. */
struct exr_place {
    uint32_t x, y;          /* of its first pixel */
    uint32_t width, height; /* of the picture; 0: the image is all of it */
};

struct exr_header {
    const struct image_text *texts; /* string attributes; may be NULL if text_count is 0 */
    uint32_t text_count;
    const float *world_to_camera; /* 16 floats, EXR's row-vector order; may be NULL */
    const float *world_to_ndc;    /* the same; may be NULL */
    struct exr_place place;
};

/*
 * Encodes an image into memory: *data (malloc'd, the caller frees it), *size bytes. Rec.709
 * chromaticities are always written. Values beyond half's range, infinities among them, are clamped
 * to +-65504 in half planes; NaN stays NaN and float planes are kept as they are. The image has at
 * least one plane. Logs and returns STATUS_TRY_AGAIN (memory) or STATUS_FAILED; *data is then NULL.
 */
MUST_USE enum status exr_encode(const struct image *image, const struct exr_header *header,
                                void **data, size_t *size);

/* Fills the planes of *rows, as many rows as it has, from row y of the picture on. */
typedef enum status exr_rows_fn(void *user, uint32_t y, struct image *rows);

/*
 * The same of a picture that is never whole in memory: `image` says its size and planes, whose
 * texels do not count; `fill` is called for its rows in their order, some at a time. Passes on what
 * it returns.
 */
MUST_USE enum status exr_encode_rows(const struct image *image, const struct exr_header *header,
                                     exr_rows_fn *fill, void *user, void **data, size_t *size);

/* A file whose rows are read some at a time. */
struct exr_file;

/*
 * Opens it, and reads its header: *image ({0} before) gets size and planes, without texels, until
 * exr_close(). Only scan lines are read. Limits and errors as exr_read(); *file is then NULL.
 */
MUST_USE enum status exr_open(struct exr_file **file, const char *path, struct image *image);

/* A text of the header, the file's; NULL if there is none of that name. */
const char *exr_text(const struct exr_file *file, const char *name);

/* Where the file's image lies in its display window; false if one has parts outside of it. */
bool exr_find_place(const struct exr_file *file, struct exr_place *place);

/* 16 floats of the header, EXR's order; false if there are none of that name. */
bool exr_matrix(const struct exr_file *file, const char *name, float *matrix);

/* Row y of a plane, the file's until the next call. Rows in their order cost least. Logs: NULL. */
const float *exr_row(struct exr_file *file, uint32_t plane, uint32_t y);

void exr_close(struct exr_file *file); /* may be NULL */

/*
 * Reads a file into *image ({0} before): the data window of its first part, channels in the file's
 * order, texels that are not finite as they are. The limits of image.h are checked before anything
 * is allocated. Not read, STATUS_DATA: deep data, subsampled channels, DWAA and DWAB. Logs and
 * returns STATUS_NO_INPUT, STATUS_DATA or STATUS_TRY_AGAIN; *image is then {0}.
 */
MUST_USE enum status exr_read(const char *path, struct image *image);

/*
 * Whether a file is such as exr_encode() makes of an image of this size, place and these planes,
 * with these texts in its header among others, and can be read to its end. Texels (which may be
 * NULL) and matrices are not compared. Logs only when the file is missing or cannot be opened.
 */
bool exr_matches(const char *path, const struct image *image, const struct exr_header *header);

/*
 * Reads a file to its end. *text: a text of its header, "" if there is none of that name; the
 * caller frees it. Limits and errors as exr_read(); *text is then NULL.
 */
MUST_USE enum status exr_inspect(const char *path, const char *name, char **text);

#endif
