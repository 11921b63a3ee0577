/*
 * file.h: the one place where output reaches the disk, and the way in to pictures.
 *
 * A file is written to a temporary beside it (".NAME.XXXXXX.tmp", X: random letters and digits),
 * checked write by write, fsynced, renamed and closed: a reader finds the complete older file or
 * the complete new one. A failure leaves the older file and no temporary. The writer holds a lock
 * (flock) on its temporary. The next write of the same file removes temporaries that nobody has
 * locked: those of processes that were killed. Where a file system has no locks, a temporary is
 * removed when it has not been written for an hour.
 */
#ifndef FIRN_IMAGE_FILE_H
#define FIRN_IMAGE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include "src/base/status.h"

/*
 * Writes size bytes to `path`, or to stdout when it is "-". An existing path that is not a
 * regular file (a pipe, a device) is written straight, without a temporary; a symbolic link is
 * followed, one to nothing is refused. Logs and returns STATUS_CANT_CREATE (cannot be opened or
 * created) or STATUS_WRITE (short write, full disk, failed fsync, close or rename).
 */
MUST_USE enum status file_write(const char *path, const void *data, size_t size);

/* Whether file_write() writes `path` straight: stdout, a pipe, a device. */
bool file_is_straight(const char *path);

/*
 * Says in advance whether file_write() could create `path` (its folder exists and can be written
 * to, it is no folder itself), so that a long render does not end in vain. Logs why not:
 * STATUS_CANT_CREATE.
 */
MUST_USE enum status file_check(const char *path);

/*
 * Opens a regular file for reading; *size in bytes. The caller closes it. Logs and returns
 * STATUS_NO_INPUT; *file is then NULL.
 */
MUST_USE enum status file_open(const char *path, FILE **file, int64_t *size);

#endif
