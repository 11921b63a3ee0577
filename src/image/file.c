/* file.c: output files, whole or not at all. */
#define _XOPEN_SOURCE 700 /* realpath() */
#include "src/image/file.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/log.h"

/* Where a path leads. */
struct target {
    bool straight;           /* to be written in place: it is there and no regular file */
    int folder;              /* descriptor, or -1 */
    char name[NAME_MAX + 1]; /* in the folder */
};

static enum status cannot_create(const char *path, const char *why)
{
    log_error("%s: cannot be created: %s", path, why);
    return STATUS_CANT_CREATE;
}

static void target_finish(struct target *target)
{
    if (target->folder >= 0)
        close(target->folder);
    target->folder = -1;
}

/* Splits a path, which it changes, and opens the folder. */
static bool open_folder(struct target *target, char *path)
{
    char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *folder = ".";

    if (strlen(name) > NAME_MAX) {
        errno = ENAMETOOLONG;
        return false;
    }
    strncpy(target->name, name, NAME_MAX);
    if (slash) {
        slash[slash == path] = '\0'; /* the root keeps its slash */
        folder = path;
    }
    target->folder = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return target->folder >= 0;
}

static enum status target_find(struct target *target, const char *path)
{
    struct stat info;
    char *real = NULL;
    bool ok;

    *target = (struct target){ .folder = -1 };
    if (stat(path, &info) == 0) {
        if (S_ISDIR(info.st_mode))
            return cannot_create(path, "it is a folder");
        if (!S_ISREG(info.st_mode)) {
            target->straight = true;
            return STATUS_OK;
        }
        real = realpath(path, NULL);
    } else if (errno != ENOENT) {
        return cannot_create(path, strerror(errno));
    } else if (lstat(path, &info) == 0) {
        return cannot_create(path, "it is a symbolic link to nothing");
    } else if (path[0] == '\0' || path[strlen(path) - 1] == '/') {
        return cannot_create(path, "it names no file");
    } else {
        real = strdup(path);
    }
    ok = real && open_folder(target, real);
    free(real);
    return ok ? STATUS_OK : cannot_create(path, strerror(errno));
}

/* ".NAME.HOST.PID.tmp", the name shortened where it would get too long. */
static void name_temporary(const char *name, long process, char temporary[static NAME_MAX + 1])
{
    char host[65] = "";
    char tail[sizeof(host) + 32];

    if (gethostname(host, sizeof(host) - 1) != 0)
        host[0] = '\0'; /* the process number has to do */
    const int tail_length = snprintf(tail, sizeof(tail), ".%s.%ld.tmp", host, process);
    snprintf(temporary, NAME_MAX + 1, ".%.*s%s", NAME_MAX - 1 - tail_length, name, tail);
}

/* The process that such a name ends with; 0: none. */
static long find_process(const char *temporary)
{
    static const char ending[] = ".tmp";
    const size_t length = strlen(temporary);
    const size_t end = length - (sizeof(ending) - 1);
    size_t start = end;
    if (length < sizeof(ending) || strcmp(temporary + end, ending) != 0)
        return 0;
    while (start > 0 && strchr("0123456789", temporary[start - 1]))
        start--;
    return end - start < 10 ? strtol(temporary + start, NULL, 10) : 0;
}

/*
 * Whether a temporary of this name was left: by a process of this machine that is no more, or by
 * one of another machine that has not written for an hour, both times by the clock of the disk.
 */
static bool is_stale(int folder, const char *name, const char *entry, time_t now)
{
    const time_t age = 3600;
    const size_t length = strlen(name);
    const long process = find_process(entry);
    char temporary[NAME_MAX + 1];
    struct stat info;

    if (process <= 0 || process == (long)getpid())
        return false;
    name_temporary(name, process, temporary);
    if (!strcmp(entry, temporary))
        return kill((pid_t)process, 0) != 0 && errno == ESRCH;
    return entry[0] == '.' && !strncmp(entry + 1, name, length) && entry[1 + length] == '.' &&
           fstatat(folder, entry, &info, AT_SYMLINK_NOFOLLOW) == 0 && now - info.st_mtime > age;
}

static void remove_stale(int folder, const char *name, time_t now)
{
    const int again = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *entries = again >= 0 ? fdopendir(again) : NULL;
    if (!entries && again >= 0)
        close(again);
    for (const struct dirent *entry; entries && (entry = readdir(entries));) {
        if (is_stale(folder, name, entry->d_name, now))
            unlinkat(folder, entry->d_name, 0);
    }
    if (entries)
        closedir(entries);
}

static int create(int folder, const char *name)
{
    return openat(folder, name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
}

static bool write_all(int file, const unsigned char *data, size_t size)
{
    while (size > 0) {
        const ssize_t count = write(file, data, size);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return false;
        data += count;
        size -= (size_t)count;
    }
    return true;
}

/* After EINTR the descriptor is closed all the same, on Linux. */
static bool close_file(int file)
{
    return close(file) == 0 || errno == EINTR;
}

/* Some file systems cannot do it for folders, and say EINVAL. */
static bool sync_folder(int folder)
{
    return fsync(folder) == 0 || errno == EINVAL;
}

static enum status cannot_write(const char *path)
{
    log_error("%s: cannot be written: %s", path, strerror(errno));
    return STATUS_WRITE;
}

static enum status write_straight(const char *path, const void *data, size_t size)
{
    const int file = open(path, O_WRONLY | O_CLOEXEC | O_NOCTTY);
    enum status status = STATUS_OK;

    if (file < 0)
        return cannot_create(path, strerror(errno));
    if (!write_all(file, data, size))
        status = cannot_write(path);
    if (!close_file(file) && status == STATUS_OK)
        status = cannot_write(path);
    return status;
}

static enum status replace(const struct target *target, const char *path, const void *data,
                           size_t size)
{
    char temporary[NAME_MAX + 1];
    struct stat info;
    int file;
    bool ok;

    name_temporary(target->name, (long)getpid(), temporary);
    file = create(target->folder, temporary);
    /* the name is this process's own, so this one was left by a dead process of the same number */
    if (file < 0 && errno == EEXIST && unlinkat(target->folder, temporary, 0) == 0)
        file = create(target->folder, temporary);
    if (file < 0)
        return cannot_create(path, strerror(errno));

    if (fstat(file, &info) == 0)
        remove_stale(target->folder, target->name, info.st_mtime);
    ok = write_all(file, data, size) && fsync(file) == 0;
    if (!ok) {
        const enum status status = cannot_write(path);
        close(file);
        unlinkat(target->folder, temporary, 0);
        return status;
    }
    ok = close_file(file) && renameat(target->folder, temporary, target->folder, target->name) == 0;
    if (!ok) {
        const enum status status = cannot_write(path);
        unlinkat(target->folder, temporary, 0);
        return status;
    }
    return sync_folder(target->folder) ? STATUS_OK : cannot_write(path);
}

enum status file_write(const char *path, const void *data, size_t size)
{
    struct target target;
    enum status status;

    if (strcmp(path, "-") == 0) {
        const bool ok = fflush(stdout) == 0 && write_all(STDOUT_FILENO, data, size);
        return ok ? STATUS_OK : cannot_write("standard output");
    }
    status = target_find(&target, path);
    if (status != STATUS_OK)
        return status;
    if (target.straight)
        status = write_straight(path, data, size);
    else
        status = replace(&target, path, data, size);
    target_finish(&target);
    return status;
}

bool file_is_straight(const char *path)
{
    struct stat info;
    return strcmp(path, "-") == 0 ||
           (stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode));
}

enum status file_check(const char *path)
{
    struct target target;
    enum status status;
    bool ok;

    if (strcmp(path, "-") == 0)
        return STATUS_OK;
    status = target_find(&target, path);
    if (status != STATUS_OK)
        return status;
    if (target.straight)
        ok = faccessat(AT_FDCWD, path, W_OK, AT_EACCESS) == 0;
    else
        ok = faccessat(target.folder, ".", W_OK | X_OK, AT_EACCESS) == 0;
    if (!ok)
        status = cannot_create(path, strerror(errno));
    target_finish(&target);
    return status;
}

enum status file_open(const char *path, FILE **file, int64_t *size)
{
    struct stat info;
    bool known;

    *size = 0;
    *file = fopen(path, "rb");
    known = *file && fstat(fileno(*file), &info) == 0;
    if (known && S_ISREG(info.st_mode)) {
        *size = info.st_size;
        return STATUS_OK;
    }
    log_error("%s: cannot be read: %s", path, known ? "no regular file" : strerror(errno));
    if (*file)
        fclose(*file);
    *file = NULL;
    return STATUS_NO_INPUT;
}
