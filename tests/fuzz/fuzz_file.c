/* fuzz_file.c: stores the input in a file that a reader opens by its name. */
#define _XOPEN_SOURCE 700 /* mkdtemp() */
#include "tests/fuzz/fuzz_file.h"
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
#include "tests/fuzz/fuzz.h"

static char folder[FUZZ_PATH_SIZE / 2];

static void remove_folder(void)
{
    DIR *entries = opendir(folder);
    const struct dirent *entry;
    while (entries && (entry = readdir(entries)))
        unlinkat(dirfd(entries), entry->d_name, 0);
    if (entries)
        closedir(entries);
    rmdir(folder);
}

static void make_folder(void)
{
    const char *parent = getenv("TMPDIR");
    const int length =
        snprintf(folder, sizeof(folder), "%s/firn-fuzz-XXXXXX", parent ? parent : "/tmp");
    FUZZ_CHECK((size_t)length < sizeof(folder) && mkdtemp(folder));
    FUZZ_CHECK(atexit(remove_folder) == 0);
}

void fuzz_file_write(char path[static FUZZ_PATH_SIZE], const char *name, const uint8_t *data,
                     size_t size)
{
    if (!folder[0])
        make_folder();
    FUZZ_CHECK(snprintf(path, FUZZ_PATH_SIZE, "%s/%s", folder, name) < FUZZ_PATH_SIZE);
    /* Not truncated first: file systems write such a file to the disk when it is closed. */
    const int file = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    FUZZ_CHECK(file >= 0);
    FUZZ_CHECK(write(file, data, size) == (ssize_t)size && ftruncate(file, (off_t)size) == 0);
    FUZZ_CHECK(close(file) == 0);
}
