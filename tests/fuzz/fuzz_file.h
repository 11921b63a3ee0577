/* fuzz_file.h: bytes as a file that a reader opens by its name. */
#ifndef TESTS_FUZZ_FILE_H
#define TESTS_FUZZ_FILE_H

#include <stddef.h>
#include <stdint.h>

enum {
    FUZZ_PATH_SIZE = 256
};

/*
 * Writes a file of this name, which has no slash, into a folder of this process below TMPDIR (or
 * /tmp), instead of an older one, and returns its path in *path. The folder is removed at exit, but
 * stays after a crash.
 */
void fuzz_file_write(char path[static FUZZ_PATH_SIZE], const char *name, const uint8_t *data,
                     size_t size);

#endif
