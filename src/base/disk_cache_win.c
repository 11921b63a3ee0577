/* disk_cache_win.c: cache files in %LOCALAPPDATA%, which Windows protects from other users. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>
#include "src/base/disk_cache.h"
#include "src/base/file_info.h"
#include "src/base/log.h"

enum {
    PATH_SIZE = MAX_PATH,
};

/* Writes the cache folder's path. Returns false if the thread has set none and Windows has none. */
static bool find_folder(char folder[static PATH_SIZE])
{
    const char *stated = disk_cache_get_folder();
    const char *local = getenv("LOCALAPPDATA");
    int length = -1;
    if (stated)
        length = snprintf(folder, PATH_SIZE, "%s", stated);
    else if (local && local[0])
        length = snprintf(folder, PATH_SIZE, "%s/firn", local);
    return length > 0 && length < PATH_SIZE;
}

/* Writes the path of a file, or of a pattern such as "bvh*". */
static bool find_path(const char *name, const char *ending, char path[static PATH_SIZE])
{
    char folder[PATH_SIZE];
    if (!find_folder(folder))
        return false;
    const int length = snprintf(path, PATH_SIZE, "%s/%s%s", folder, name, ending);
    return length > 0 && length < PATH_SIZE;
}

/* Reads a file. Returns NULL if it is empty, is too large or fails is_sound(). */
static char *read_valid(FILE *file, const struct disk_cache_file *request, size_t *size)
{
    const struct file_info info = file_info_of_open(file);
    if (info.kind != FILE_REGULAR || info.size <= 0 || (uint64_t)info.size > request->size_max)
        return NULL;
    *size = (size_t)info.size;
    char *data = malloc(*size);
    if (data && fread(data, 1, *size, file) == *size &&
        request->is_sound(request->user, data, *size))
        return data;
    free(data);
    return NULL;
}

/* Sets the time of the last write of a file to the present, for eviction. */
static void touch(const char *path)
{
    FILETIME now;
    const HANDLE handle = CreateFileA(path, FILE_WRITE_ATTRIBUTES, FILE_SHARE_READ, NULL,
                                      OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, NULL);
    if (handle == INVALID_HANDLE_VALUE)
        return;
    GetSystemTimeAsFileTime(&now);
    (void)SetFileTime(handle, NULL, NULL, &now);
    (void)CloseHandle(handle);
}

void *disk_cache_read(const struct disk_cache_file *request, size_t *size)
{
    char path[PATH_SIZE];
    FILE *file = find_path(request->name, "", path) ? fopen(path, "rb") : NULL;
    *size = 0;
    if (!file)
        return NULL;
    char *data = read_valid(file, request, size);
    fclose(file);
    if (data)
        touch(path);
    else if (!request->is_quiet)
        log_warning("%s: ignored because it is damaged; it will be rewritten", path);
    *size = data ? *size : 0;
    return data;
}

void disk_cache_write(const char *name, void *data, size_t size)
{
    char folder[PATH_SIZE], path[PATH_SIZE], temporary[PATH_SIZE];
    const uint64_t value = disk_cache_hash(data, size);
    if (!find_folder(folder) || !find_path(name, "", path))
        return;
    memcpy((char *)data + size, &value, DISK_CACHE_HASH_SIZE);
    (void)CreateDirectoryA(folder, NULL);
    FILE *file = GetTempFileNameA(folder, "tmp", 0, temporary) ? fopen(temporary, "wb") : NULL;
    if (!file)
        return;
    size += DISK_CACHE_HASH_SIZE;
    const bool is_written = fwrite(data, 1, size, file) == size;
    const bool is_closed = fclose(file) == 0;
    if (!is_written || !is_closed || !MoveFileExA(temporary, path, MOVEFILE_REPLACE_EXISTING))
        (void)DeleteFileA(temporary);
}

/* Total size of all cache files with a given prefix, and the least recently used of these files. */
struct cache_usage {
    uint64_t bytes;
    FILETIME used;
    char name[MAX_PATH]; /* "" if there is none */
};

static struct cache_usage scan_folder(const char *prefix)
{
    struct cache_usage usage = { .bytes = 0 };
    char pattern[PATH_SIZE];
    WIN32_FIND_DATAA found;
    if (!find_path(prefix, "*", pattern))
        return usage;
    const HANDLE search = FindFirstFileA(pattern, &found);
    if (search == INVALID_HANDLE_VALUE)
        return usage;
    do {
        if (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY)
            continue;
        usage.bytes += (uint64_t)found.nFileSizeHigh << 32 | found.nFileSizeLow;
        if (usage.name[0] && CompareFileTime(&found.ftLastWriteTime, &usage.used) >= 0)
            continue;
        usage.used = found.ftLastWriteTime;
        snprintf(usage.name, sizeof(usage.name), "%s", found.cFileName);
    } while (FindNextFileA(search, &found));
    (void)FindClose(search);
    return usage;
}

void disk_cache_evict(const char *prefix, uint64_t bytes_max)
{
    char path[PATH_SIZE];
    for (struct cache_usage usage = scan_folder(prefix); usage.bytes > bytes_max && usage.name[0];
         usage = scan_folder(prefix)) {
        if (!find_path(usage.name, "", path) || !DeleteFileA(path))
            return;
    }
}
