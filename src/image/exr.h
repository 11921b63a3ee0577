/*
 * exr.h: reads and writes OpenEXR files with the OpenEXR Core C API.
 *
 * Files are written as a single part with scan lines, ZIP compression, channels sorted by name,
 * half or float per plane, and no timestamp, so that equal images give bit-identical files. Reading
 * uses one part: scan lines or tiles (level 0), channels of any pixel type.
 */
#ifndef FIRN_IMAGE_EXR_H
#define FIRN_IMAGE_EXR_H

#include "src/base/status.h"
#include "src/image/image.h"
#include "src/image/image_header.h"

struct exr_header {
    const struct image_text *texts; /* string attributes; may be NULL */
    uint32_t text_count;
    const float *world_to_camera; /* row-vector order; may be NULL */
    const float *world_to_ndc;    /* row-vector order; may be NULL */
    struct image_window window;
    double frames_per_second; /* 0 omits the attribute */
};

/*
 * Encodes an image into memory: *data (malloc'd, freed by the caller) of *size bytes. Rec.709
 * chromaticities are always written. Half planes are clamped to +-65504, including infinities, but
 * not NaN; float planes are stored unchanged. At least one plane is required. On failure logs, sets
 * *data to NULL, and returns STATUS_TRY_AGAIN (memory) or STATUS_FAILED.
 */
MUST_USE enum status exr_encode(const struct image *image, const struct exr_header *header,
                                void **data, size_t *size);

/* Callback that fills *rows with rows->height rows of the image, from row y on. */
typedef enum status exr_rows_fn(void *user, uint32_t y, struct image *rows);

/*
 * Encodes an image like exr_encode(), but without holding all of it in memory. `image` gives only
 * the size and the planes; its texels are not used. `fill` is called for successive groups of rows.
 * If `fill` fails, its status is returned.
 */
MUST_USE enum status exr_encode_rows(const struct image *image, const struct exr_header *header,
                                     exr_rows_fn *fill, void *user, void **data, size_t *size);

struct exr_file;

/*
 * Opens a file and reads its header into *head, which the caller finishes: the data window and
 * channels of one part. The part is the first with channels R, G and B, else the first that is not
 * deep; several parts cause a warning. The limits of image.h are checked before any allocation.
 * Deep data, subsampled channels, DWAA and DWAB are not supported: STATUS_DATA. Logs and returns
 * STATUS_NO_INPUT, STATUS_DATA or STATUS_TRY_AGAIN; *file is then NULL and *head {0}.
 */
MUST_USE enum status exr_open(struct exr_file **opened, const char *path,
                              struct image_header *head);

/* Sets *row to row y of a plane, owned by the file and valid until the next call. Texels may be
 * non-finite. Reading rows in ascending order is fastest. */
MUST_USE enum status exr_row(struct exr_file *file, uint32_t plane, uint32_t y, const float **row);

void exr_close(struct exr_file *file); /* may be NULL */

/* Reads a file into *image, zeroed before and on failure. Errors are those of exr_open(). */
MUST_USE enum status exr_read(const char *path, struct image *image);

/* Reads an image like exr_read(), and *head, which the caller frees. *head is zeroed on failure. */
MUST_USE enum status exr_read_all(const char *path, struct image *image, struct image_header *head);

/* Decodes a whole file to check it, and reads its header into *head like exr_open(). */
MUST_USE enum status exr_check(const char *path, struct image_header *head);

/* Returns true if `head` has the size, windows, planes and texts that exr_encode() would write for
 * the image. `head` may have additional texts. Texels and matrices are not compared. */
bool exr_matches(const struct image_header *head, const struct image *image,
                 const struct exr_header *header);

#endif
