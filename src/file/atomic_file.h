/*
 * atomic_file.h: atomic writing of all output files, and opening of input files.
 *
 * A file is written to a temporary file beside it (".NAME.XXXXXX.tmp", X: random letters and
 * digits), every write is checked, and it is fsynced, renamed and closed, so that other programs
 * find either the complete old file or the complete new one. A failure leaves the old file and no
 * temporary. A replaced file keeps its mode; the temporary is never accessible to more users. The
 * writer locks (flock) its temporary. The next write of the same file removes unlocked temporaries
 * of killed processes; on file systems without locks, those not modified for an hour.
 */
#ifndef FIRN_FILE_ATOMIC_FILE_H
#define FIRN_FILE_ATOMIC_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include "src/base/status.h"

/*
 * Writes `size` bytes to `path`, or to stdout if `path` is "-". An existing pipe or device is
 * written directly, without a temporary file. A symbolic link is followed; a dangling link is
 * rejected. Logs errors. If opening or creating the file fails, returns STATUS_CANT_CREATE. If
 * writing, fsync, close or rename fails, returns STATUS_WRITE.
 */
MUST_USE enum status file_io_write(const char *path, const void *data, size_t size);

/* Returns true if file_io_write() writes to `path` directly (stdout, a pipe or a device). */
bool file_io_is_direct(const char *path);

/*
 * Checks before a long computation that `path` is not a folder and that its folder is writable. If
 * not, logs why and returns STATUS_CANT_CREATE.
 */
MUST_USE enum status file_io_check(const char *path);

/*
 * Opens a regular file for reading and sets *size to its size in bytes. The caller closes the file.
 * If opening fails, logs an error, sets *file to NULL and returns STATUS_NO_INPUT.
 */
MUST_USE enum status file_io_open(const char *path, FILE **file, int64_t *size);

#endif
