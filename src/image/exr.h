/*
 * exr.h: reads and writes OpenEXR files by the Core C API.
 *
 * Files are written with one part, scan lines, ZIP compression, channels sorted by name, half or
 * float for each plane, and no time of day, so that equal pictures give equal bytes. Of files that
 * are read, one part counts: scan lines or tiles (level 0), channels of any pixel type.
 */
#ifndef FIRN_IMAGE_EXR_H
#define FIRN_IMAGE_EXR_H

#include "src/base/status.h"
#include "src/image/image.h"
#include "src/image/picture_head.h"

struct exr_header {
    const struct image_text *texts; /* string attributes; may be NULL if text_count is 0 */
    uint32_t text_count;
    const float *world_to_camera; /* 16 floats, EXR's row-vector order; may be NULL */
    const float *world_to_ndc;    /* 16 floats, EXR's row-vector order; may be NULL */
    struct picture_place place;
    double frames_per_second; /* of a sequence; 0: no attribute */
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
 * Opens a file and reads its header into *head, which the caller finishes: the data window of one
 * part, channels in the file's order. The part is the first with channels R, G and B, or else the
 * first that is not deep; if there are several, a warning says which. The limits of image.h are
 * checked before any allocation. Deep data, subsampled channels, DWAA and DWAB are not supported:
 * STATUS_DATA. Logs and returns STATUS_NO_INPUT, STATUS_DATA or STATUS_TRY_AGAIN; *file is then
 * NULL and *head {0}.
 */
MUST_USE enum status exr_open(struct exr_file **file, const char *path, struct picture_head *head);

/* Returns row y of a plane in *row, owned by the file and valid until the next call. Texels that
 * are not finite are unchanged. Reading rows in ascending order is fastest. */
MUST_USE enum status exr_row(struct exr_file *file, uint32_t plane, uint32_t y, const float **row);

void exr_close(struct exr_file *file); /* may be NULL */

/* Reads a file into *image, which must be {0}. Errors are those of exr_open(); *image is then
 * {0}. */
MUST_USE enum status exr_read(const char *path, struct image *image);

/* The same with what else the file says; the caller finishes *head, which is {0} on failure. */
MUST_USE enum status exr_read_all(const char *path, struct image *image, struct picture_head *head);

/* Reads a file to its end, to check it, and returns its header as exr_open() does. */
MUST_USE enum status exr_check(const char *path, struct picture_head *head);

/* Returns whether a header is that of a picture of exr_encode() with the image's size, place and
 * planes, and with these texts, among others. Texels (which may be NULL) and matrices are not
 * compared. */
bool exr_matches(const struct picture_head *head, const struct image *image,
                 const struct exr_header *header);

#endif
