/*
 * image_reader.h: reads .exr, .hdr and .png images in a reader process (errors: reader.h).
 */
#ifndef FIRN_READER_IMAGE_READER_H
#define FIRN_READER_IMAGE_READER_H

#include "src/image/image.h"
#include "src/image/image_header.h"
#include "src/reader/reader.h"

/* Returns true if a path has the suffix of a supported image format. */
bool image_reader_knows_suffix(const char *path);

/* An image that is read row by row. */
struct image_reader;

/* Starts to read an image; `path` and `params` must outlive the reader. The caller finishes *head.
 * On failure *picture is NULL and *head {0}. */
MUST_USE enum status image_reader_open(struct image_reader **picture, const char *path,
                                       const struct reader_params *params,
                                       struct image_header *head);

/* Returns row y of a plane in *row, owned by the reader and valid until the next call. Rows must be
 * read in ascending order; some may be skipped. After a failure call only image_reader_close(). */
MUST_USE enum status image_reader_row(struct image_reader *picture, uint32_t plane, uint32_t y,
                                      const float **row);

/* Closes the reader, even before the last row. It may be NULL. */
void image_reader_close(struct image_reader *picture);

/* Reads a whole image into *image, which must be {0}. The texels may take up to a quarter of the
 * memory limit (1 GiB by default). On failure *image is {0}. */
MUST_USE enum status image_reader_read(struct image *image, const char *path,
                                       const struct reader_params *params);

/* Decodes a whole image to check it. The caller finishes its header *head, {0} on failure. */
MUST_USE enum status image_reader_check(struct image_header *head, const char *path,
                                        const struct reader_params *params);

/* ---- in the child process ---- */

/* Decode an image and write its header, and image_send() also its rows, to a sink. */
MUST_USE enum status image_send(const char *path, const struct pipe_sink *sink);
MUST_USE enum status image_send_header(const char *path, const struct pipe_sink *sink);

/* ---- in both processes ---- */

/* Serialise and validate the header of an image; used by both processes and by tests. */
MUST_USE bool image_pipe_write_header(const struct pipe_sink *sink,
                                      const struct image_header *head);
MUST_USE enum pipe_fault image_pipe_read_header(const struct pipe_source *source,
                                                struct image_header *head);

#endif
