/* image_receive.h: reads .exr, .hdr and .png images in a reader process. reader_process.h describes
 * the errors. */
#ifndef FIRN_FILE_IMAGE_RECEIVE_H
#define FIRN_FILE_IMAGE_RECEIVE_H

#include "src/file/image.h"
#include "src/file/reader_process.h"

/* Returns true if a path has the suffix of a supported image format. */
bool image_reader_knows_suffix(const char *path);

struct image_reader;

/* Starts to read an image. `path` and `params` must outlive the reader. The caller frees *head. If
 * this fails, *opened is NULL and *head is zeroed. */
MUST_USE enum status image_reader_open(struct image_reader **opened, const char *path,
                                       const struct reader_params *params,
                                       struct image_header *head);

/* Points *row to row y of a plane. The row stays valid until the next call. Rows must be read in
 * ascending order; some may be skipped. After a failure, only image_reader_close() is allowed. */
MUST_USE enum status image_reader_row(struct image_reader *image_reader, uint32_t plane, uint32_t y,
                                      const float **row);

/* Closes a reader, even before all rows are read. `image_reader` may be NULL. */
void image_reader_close(struct image_reader *image_reader);

/* Reads a whole image into *image, which must be zeroed. If reading fails, *image is zeroed. Texels
 * may take up to a quarter of the memory limit; the default is a quarter of 4 GiB. */
MUST_USE enum status image_reader_read(struct image *image, const char *path,
                                       const struct reader_params *params);

/* Reads and checks a whole image. The caller frees *head, which is zeroed on failure. */
MUST_USE enum status image_reader_check(struct image_header *head, const char *path,
                                        const struct reader_params *params);

/* Decodes an image in the child process and sends its header and rows. */
MUST_USE enum status image_send(const char *path, const struct pipe_sink *sink);
/* Checks a whole image in the child process, but sends only its header. */
MUST_USE enum status image_send_header(const char *path, const struct pipe_sink *sink);

/* Sends an image's header to the other process; image_pipe_read_header() receives it. */
MUST_USE bool image_pipe_write_header(const struct pipe_sink *sink,
                                      const struct image_header *head);
MUST_USE enum pipe_fault image_pipe_read_header(const struct pipe_source *source,
                                                struct image_header *head);

#endif
