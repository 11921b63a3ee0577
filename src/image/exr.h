/*
 * exr.h: reads and writes OpenEXR files by the Core C API.
 *
 * Files are written with one part, scan lines, ZIP compression, channels sorted by name, half or
 * float for each plane, and no time of day, so that equal pictures give equal bytes. Of files that
 * are read, the first part counts: scan lines or tiles (level 0), channels of any pixel type.
 */
#ifndef FIRN_IMAGE_EXR_H
#define FIRN_IMAGE_EXR_H

#include "src/base/status.h"
#include "src/image/image.h"

/* The position of an image in a larger picture: its data window in the display window. */
struct exr_place {
    uint32_t x, y;          /* first pixel of the image */
    uint32_t width, height; /* pixels of the picture; 0: the image is the whole picture */
};

struct exr_header {
    const struct image_text *texts; /* string attributes; may be NULL if text_count is 0 */
    uint32_t text_count;
    const float *world_to_camera; /* 16 floats, EXR's row-vector order; may be NULL */
    const float *world_to_ndc;    /* 16 floats, EXR's row-vector order; may be NULL */
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

/* Fills all rows of *rows with the rows of the picture from y on. */
typedef enum status exr_rows_fn(void *user, uint32_t y, struct image *rows);

/*
 * Encodes a picture as exr_encode() does, without holding all of it in memory: `image` has its size
 * and planes, whose texels are not used; `fill` is called for successive groups of rows. If `fill`
 * fails, returns its status.
 */
MUST_USE enum status exr_encode_rows(const struct image *image, const struct exr_header *header,
                                     exr_rows_fn *fill, void *user, void **data, size_t *size);

/* A file that is read row by row. */
struct exr_file;

/*
 * Opens a file of scan lines and reads its header: *image, which must be {0}, receives size and
 * planes without texels, valid until exr_close(). Limits and errors are those of exr_read(); on
 * failure *file is NULL.
 */
MUST_USE enum status exr_open(struct exr_file **file, const char *path, struct image *image);

/* Returns a text of the header, owned by the file, or NULL if there is none of that name. */
const char *exr_text(const struct exr_file *file, const char *name);

/* Returns the position of the file's image in its display window; false if it is partly outside. */
bool exr_find_place(const struct exr_file *file, struct exr_place *place);

/* Copies a matrix of the header, 16 floats in EXR's order; false if there is none of that name. */
bool exr_matrix(const struct exr_file *file, const char *name, float *matrix);

/* Returns row y of a plane, owned by the file and valid until the next call, or NULL after logging
 * an error. Reading rows in ascending order is fastest. */
const float *exr_row(struct exr_file *file, uint32_t plane, uint32_t y);

void exr_close(struct exr_file *file); /* may be NULL */

/*
 * Reads a file into *image, which must be {0}: the data window of its first part, channels in the
 * file's order, with texels that are not finite unchanged. The limits of image.h are checked before
 * any allocation. Deep data, subsampled channels, DWAA and DWAB are not supported: STATUS_DATA.
 * Logs and returns STATUS_NO_INPUT, STATUS_DATA or STATUS_TRY_AGAIN; *image is then {0}.
 */
MUST_USE enum status exr_read(const char *path, struct image *image);

/*
 * Returns whether a file is complete and has the format of exr_encode(), the image's size, place
 * and planes, and these texts, among others, in its header. Texels (which may be NULL) and matrices
 * are not compared. Logs only if the file is missing or cannot be opened.
 */
bool exr_matches(const char *path, const struct image *image, const struct exr_header *header);

/*
 * Reads a file to its end, to check it, and returns a text of its header in *text, which the caller
 * frees: "" if there is none of that name. Limits and errors are those of exr_read(); on failure
 * *text is NULL.
 */
MUST_USE enum status exr_inspect(const char *path, const char *name, char **text);

#endif
