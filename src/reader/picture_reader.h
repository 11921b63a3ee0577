/*
 * picture_reader.h: pictures through a reader process (reader.h, with its errors): .exr, .hdr and
 * .png files, by the ends of their names.
 */
#ifndef FIRN_READER_PICTURE_READER_H
#define FIRN_READER_PICTURE_READER_H

#include "src/image/image.h"
#include "src/image/picture_head.h"
#include "src/reader/reader.h"

/* Returns whether picture files have names that end so. */
bool picture_is_named(const char *path);

/* A picture that is read row by row. */
struct picture_reader;

/* Starts to read; `path` and `params` must outlive the reader. *head is finished by the caller. On
 * failure *picture is NULL and *head {0}. */
MUST_USE enum status picture_open(struct picture_reader **picture, const char *path,
                                  const struct reader_params *params, struct picture_head *head);

/* Returns row y of a plane in *row, owned by the reader and valid until the next call. Rows are
 * read in ascending order; those between are skipped. After a failure only picture_close() may
 * follow. */
MUST_USE enum status picture_row(struct picture_reader *picture, uint32_t plane, uint32_t y,
                                 const float **row);

/* Ends the reader, with or without its last row. It may be NULL. */
void picture_close(struct picture_reader *picture);

/* Reads a whole picture into *image, which must be {0}. Its texels may be a quarter of the limit of
 * memory: 1 GiB, if that is not given. On failure *image is {0}. */
MUST_USE enum status picture_read(struct image *image, const char *path,
                                  const struct reader_params *params);

/* Reads a picture to its end, to check it, and returns its head, which the caller finishes. On
 * failure *head is {0}. */
MUST_USE enum status picture_check(struct picture_head *head, const char *path,
                                   const struct reader_params *params);

/* ---- in the child ---- */

/* Read a picture and send its head, and, but for the second, its rows. */
MUST_USE enum status picture_send(const char *path, const struct pipe_sink *sink);
MUST_USE enum status picture_send_check(const char *path, const struct pipe_sink *sink);

/* ---- both ---- */

/* The head on its way, for the two ends above and for tests. */
MUST_USE bool picture_pipe_write_head(const struct pipe_sink *sink,
                                      const struct picture_head *head);
MUST_USE enum pipe_fault picture_pipe_read_head(const struct pipe_source *source,
                                                struct picture_head *head);

#endif
