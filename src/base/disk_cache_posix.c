/* disk_cache_posix.c: cache files with ownership check and LRU eviction. */
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/base/disk_cache.h"
#include "src/base/log.h"

enum {
    FOLDER_SIZE = 2048,
    PATH_SIZE = FOLDER_SIZE + 152,
};

/* Writes the cache folder's path. Returns false if the thread has set none and neither
 * XDG_CACHE_HOME nor HOME is absolute. */
static bool find_folder(char folder[static FOLDER_SIZE])
{
    const char *stated = disk_cache_get_folder();
    const char *cache = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    int length = -1;
    if (stated)
        length = snprintf(folder, FOLDER_SIZE, "%s", stated);
    else if (cache && cache[0] == '/')
        length = snprintf(folder, FOLDER_SIZE, "%s/firn", cache);
    else if (home && home[0] == '/')
        length = snprintf(folder, FOLDER_SIZE, "%s/.cache/firn", home);
    return length > 0 && length < FOLDER_SIZE;
}

static bool find_path(const char *folder, const char *name, char path[static PATH_SIZE])
{
    const int length = snprintf(path, PATH_SIZE, "%s/%s", folder, name);
    return length > 0 && length < PATH_SIZE;
}

static bool read_all(int file, char *data, size_t size)
{
    for (size_t done = 0; done < size;) {
        const ssize_t got = read(file, data + done, size - done);
        if (got <= 0)
            return false;
        done += (size_t)got;
    }
    return true;
}

static bool write_all(int file, const char *data, size_t size)
{
    for (size_t done = 0; done < size;) {
        const ssize_t put = write(file, data + done, size - done);
        if (put <= 0)
            return false;
        done += (size_t)put;
    }
    return true;
}

/* Returns true if only the user can write to a file or folder. Forged data could crash drivers. */
static bool is_own(const struct stat *info)
{
    return info->st_uid == geteuid() && !(info->st_mode & (S_IWGRP | S_IWOTH));
}

/* Reads an open file. Returns NULL if it is not regular, is too large or fails is_sound(). */
static char *read_valid(int file, const struct stat *info, const struct disk_cache_file *request)
{
    if (!S_ISREG(info->st_mode) || info->st_size <= 0 ||
        (uint64_t)info->st_size > (uint64_t)request->size_max)
        return NULL;
    const size_t size = (size_t)info->st_size;
    char *data = malloc(size);
    if (data && read_all(file, data, size) && request->is_sound(request->user, data, size))
        return data;
    free(data);
    return NULL;
}

void *disk_cache_read(const struct disk_cache_file *request, size_t *size)
{
    char folder[FOLDER_SIZE];
    char path[PATH_SIZE];
    struct stat info = { 0 }, folder_info;
    if (!find_folder(folder) || !find_path(folder, request->name, path))
        return NULL;
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        return NULL;
    const bool is_regular = fstat(file, &info) == 0 && S_ISREG(info.st_mode);
    if (is_regular && !(is_own(&info) && stat(folder, &folder_info) == 0 && is_own(&folder_info))) {
        close(file);
        log_warning("%s: ignored because other users can write it or its folder", path);
        return NULL;
    }
    char *data = is_regular ? read_valid(file, &info, request) : NULL;
    if (data)
        (void)futimens(file, NULL);
    close(file);
    if (!data && !request->is_quiet)
        log_warning("%s: ignored because it is damaged; it will be rewritten", path);
    *size = data ? (size_t)info.st_size : 0;
    return data;
}

/* Creates the cache folder and, if missing, its parent (~/.cache). */
static void make_folder(char *folder)
{
    char *slash = strrchr(folder, '/');
    *slash = '\0';
    (void)mkdir(folder, 0700);
    *slash = '/';
    (void)mkdir(folder, 0700);
}

void disk_cache_write(const char *name, void *data, size_t size)
{
    char folder[FOLDER_SIZE];
    char path[PATH_SIZE];
    char temporary[PATH_SIZE + 56];
    if (!find_folder(folder) || !find_path(folder, name, path))
        return;
    const uint64_t value = disk_cache_hash(data, size);
    memcpy((char *)data + size, &value, DISK_CACHE_HASH_SIZE);
    make_folder(folder);
    snprintf(temporary, sizeof(temporary), "%s.XXXXXX", path);
    const int file = mkstemp(temporary);
    if (file < 0)
        return;
    const bool written = write_all(file, data, size + DISK_CACHE_HASH_SIZE);
    const bool closed = close(file) == 0;
    if (!written || !closed || rename(temporary, path) != 0)
        (void)unlink(temporary);
}

/* Total size of all cache files with a given prefix, and the least recently used of these files. */
struct cache_usage {
    uint64_t bytes;
    struct timespec used;
    char name[256]; /* "" if there is none */
};

static bool is_before(const struct timespec *a, const struct timespec *b)
{
    return a->tv_sec < b->tv_sec || (a->tv_sec == b->tv_sec && a->tv_nsec < b->tv_nsec);
}

static struct cache_usage scan_folder(DIR *folder, const char *prefix)
{
    struct cache_usage usage = { .bytes = 0 };
    rewinddir(folder);
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        struct stat info;
        if (strncmp(entry->d_name, prefix, strlen(prefix)) != 0 ||
            fstatat(dirfd(folder), entry->d_name, &info, AT_SYMLINK_NOFOLLOW) != 0 ||
            !S_ISREG(info.st_mode))
            continue;
        usage.bytes += (uint64_t)info.st_size;
        if (usage.name[0] && !is_before(&info.st_mtim, &usage.used))
            continue;
        usage.used = info.st_mtim;
        snprintf(usage.name, sizeof(usage.name), "%s", entry->d_name);
    }
    return usage;
}

void disk_cache_evict(const char *prefix, uint64_t bytes_max)
{
    char path[FOLDER_SIZE];
    DIR *folder = find_folder(path) ? opendir(path) : NULL;
    if (!folder)
        return;
    for (struct cache_usage usage = scan_folder(folder, prefix);
         usage.bytes > bytes_max && usage.name[0]; usage = scan_folder(folder, prefix)) {
        if (unlinkat(dirfd(folder), usage.name, 0) != 0)
            break;
    }
    closedir(folder);
}
