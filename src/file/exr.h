/*
 * exr.h: reads and writes OpenEXR files with the OpenEXR Core C API.
 *
 * Files are written as a single part with scan lines, ZIP compression, channels sorted by name,
 * half or float per plane, and no timestamp, so that equal images give bit-identical files. Reading
 * uses one part: scan lines or tiles (level 0), channels of any pixel type.
 */
#ifndef FIRN_FILE_EXR_H
#define FIRN_FILE_EXR_H

#include "src/base/status.h"
#include "src/file/image.h"

struct exr_header {
    const struct image_text *texts; /* string attributes; may be NULL */
    uint32_t text_count;
    const float *world_to_camera; /* row-vector order; may be NULL */
    const float *world_to_ndc;    /* row-vector order; may be NULL */
    struct image_window window;
    double frames_per_second; /* 0 omits the attribute */
};

/*
 * Encodes an image as an OpenEXR file in memory. *data receives *size bytes, which the caller
 * frees. Rec.709 chromaticities are always written. Values of half planes, except NaN, are clamped
 * to +-65504. Float planes are stored unchanged. At least one plane is required. On failure logs,
 * sets *data to NULL, and returns STATUS_TRY_AGAIN (out of memory) or STATUS_FAILED.
 */
MUST_USE enum status exr_encode(const struct image *image, const struct exr_header *header,
                                void **data, size_t *size);

/* Callback that fills *rows with rows->height rows of the image, from row y on. */
typedef enum status exr_rows_fn(void *user, uint32_t y, struct image *rows);

/*
 * Encodes an image like exr_encode(), but without holding the whole image in memory. `image` gives
 * only the size and the planes; its texels are not used. `fill` is called for successive groups of
 * rows. If `fill` fails, returns the status of `fill`.
 */
MUST_USE enum status exr_encode_rows(const struct image *image, const struct exr_header *header,
                                     exr_rows_fn *fill, void *user, void **data, size_t *size);

struct exr_file;

/*
 * Opens a file. *head receives the data window and channels of one part, and the caller finishes
 * it. The part is the first with channels R, G and B or, if there is none, the first with a layer
 * that has these ("name.R") or, if there is none, the first non-deep part. Several parts cause a
 * warning. The limits of image.h are checked before any allocation. Deep data, subsampled channels,
 * DWAA and DWAB are rejected with STATUS_DATA. Logs and returns STATUS_NO_INPUT, STATUS_DATA or
 * STATUS_TRY_AGAIN; *opened is then NULL and *head {0}.
 */
MUST_USE enum status exr_open(struct exr_file **opened, const char *path,
                              struct image_header *head);

/* Points *row to row y of a plane. The row belongs to the file and stays valid until the next call.
 * Texels may be NaN or infinite. Reading rows in ascending order is fastest. */
MUST_USE enum status exr_row(struct exr_file *file, uint32_t plane, uint32_t y, const float **row);

void exr_close(struct exr_file *file); /* may be NULL */

/* Reads a whole image into *image, which must be zeroed, and its header. On failure *image and
 * *head are zeroed. The caller frees *head. exr_open() describes the limits and errors. */
MUST_USE enum status exr_read(const char *path, struct image *image, struct image_header *head);

/* Checks a file by decoding all texels. Reads the header into *head, which the caller frees. */
MUST_USE enum status exr_check(const char *path, struct image_header *head);

/* Returns true if `head` has the size, windows, planes and texts that exr_encode() would write for
 * the image. `head` may have additional texts. Texels and matrices are not compared. */
bool exr_matches(const struct image_header *head, const struct image *image,
                 const struct exr_header *header);

#endif
