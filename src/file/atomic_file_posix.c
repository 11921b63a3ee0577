/* atomic_file_posix.c: writes output files atomically, by a locked temporary file and rename(). */
#define _XOPEN_SOURCE 700 /* realpath() */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/base/log.h"
#include "src/file/atomic_file.h"

enum {
    RANDOM_LENGTH = 6,
    ATTEMPTS_MAX = 100,
    STALE_SECONDS = 3600,
};

static const char suffix[] = ".tmp";
static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

/* Resolved location of an output file. */
struct target {
    bool is_direct;          /* not a regular file: written directly */
    int folder;              /* descriptor, or -1 */
    char name[NAME_MAX + 1]; /* file name within the folder */
};

static enum status cannot_create(const char *path, const char *reason)
{
    log_error("%s: cannot be created: %s", path, reason);
    return STATUS_CANT_CREATE;
}

static void target_finish(struct target *target)
{
    if (target->folder >= 0)
        close(target->folder);
    target->folder = -1;
}

/* Splits a path into folder and name, and opens the folder. Modifies `path`. */
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
        slash[slash == path] = '\0'; /* the root folder keeps its slash */
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
            return cannot_create(path, "is a folder");
        if (!S_ISREG(info.st_mode)) {
            target->is_direct = true;
            return STATUS_OK;
        }
        real = realpath(path, NULL);
    } else if (errno != ENOENT) {
        return cannot_create(path, strerror(errno));
    } else if (lstat(path, &info) == 0) {
        return cannot_create(path, "is a dangling symbolic link");
    } else if (path[0] == '\0' || path[strlen(path) - 1] == '/') {
        return cannot_create(path, "has no file name");
    } else {
        real = strdup(path);
    }
    ok = real && open_folder(target, real);
    free(real);
    return ok ? STATUS_OK : cannot_create(path, strerror(errno));
}

/* Temporary file, locked while it is open. */
struct temporary {
    int file;                /* descriptor, or -1 */
    char name[NAME_MAX + 1]; /* file name within the target's folder */
};

/* Returns the length of the prefix ".NAME." of temporary files, where a long NAME is truncated. */
static int prefix_length(const char *name)
{
    const int longest = NAME_MAX - (RANDOM_LENGTH + (int)strlen(suffix));
    const int length = (int)strlen(name) + 2;
    return length < longest ? length : longest;
}

/* Generates the name of a temporary file, ".NAME.XXXXXX.tmp", with unpredictable letters. */
static bool name_temporary(const char *name, char temporary[static NAME_MAX + 1])
{
    unsigned char random[RANDOM_LENGTH];
    char word[RANDOM_LENGTH + 1] = "";
    if (getrandom(random, sizeof(random), 0) != (ssize_t)sizeof(random))
        return false;
    for (int i = 0; i < RANDOM_LENGTH; i++)
        word[i] = letters[random[i] % strlen(letters)];
    snprintf(temporary, NAME_MAX + 1, ".%.*s.%s%s", prefix_length(name) - 2, name, word, suffix);
    return true;
}

/* Returns true if `entry` is the name of a temporary file for the output file `name`. */
static bool is_temporary(const char *entry, const char *name)
{
    const int length = prefix_length(name);
    return entry[0] == '.' && !strncmp(entry + 1, name, (size_t)length - 2) &&
           entry[length - 1] == '.' && strspn(entry + length, letters) == RANDOM_LENGTH &&
           !strcmp(entry + length + RANDOM_LENGTH, suffix);
}

static bool is_still_named(int folder, const char *name, int file)
{
    struct stat named, opened;
    return fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 && fstat(file, &opened) == 0 &&
           named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
}

static void remove_temporary(const struct target *target, struct temporary *temporary)
{
    if (is_still_named(target->folder, temporary->name, temporary->file))
        unlinkat(target->folder, temporary->name, 0);
    close(temporary->file);
}

/* Returns the permissions of the file to be replaced, or -1 if there is none. */
static int find_mode(const struct target *target)
{
    struct stat old_mode;
    if (fstatat(target->folder, target->name, &old_mode, 0) != 0 || !S_ISREG(old_mode.st_mode))
        return -1;
    return (int)(old_mode.st_mode & 0777);
}

/* Creates and locks a temporary file. `old_mode` is the mode of the file to be replaced, or -1 if
 * there is none. Users who may not read the old file may not read the temporary file. If another
 * process removes the temporary file before it is locked, tries another name. */
static bool open_temporary(const struct target *target, int old_mode, struct temporary *temporary)
{
    const int flags = O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW;
    const mode_t mode = old_mode < 0 ? 0666 : (mode_t)(old_mode & 0666) | 0600;
    for (int attempt = 0; attempt < ATTEMPTS_MAX; attempt++) {
        if (!name_temporary(target->name, temporary->name))
            return false;
        temporary->file = openat(target->folder, temporary->name, flags, mode);
        if (temporary->file < 0 && errno != EEXIST)
            return false;
        if (temporary->file < 0)
            continue;
        const bool is_ours = flock(temporary->file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
        if (is_ours && is_still_named(target->folder, temporary->name, temporary->file))
            return true;
        close(temporary->file);
    }
    errno = EEXIST;
    return false;
}

/*
 * Returns true if an open temporary file is abandoned. If the file can be locked, it is abandoned,
 * because writers hold a lock until they exit. On file systems without locks, the file is abandoned
 * if it was not modified for an hour.
 */
static bool is_stale(int file, time_t now)
{
    struct stat info;
    if (fstat(file, &info) != 0 || !S_ISREG(info.st_mode))
        return false;
    if (flock(file, LOCK_EX | LOCK_NB) == 0)
        return true;
    return errno != EWOULDBLOCK && now - info.st_mtime > STALE_SECONDS;
}

static void remove_if_stale(int folder, const char *entry, time_t now)
{
    const int flags = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
    const int file = openat(folder, entry, flags);
    if (file < 0)
        return;
    if (is_stale(file, now) && is_still_named(folder, entry, file))
        unlinkat(folder, entry, 0);
    close(file);
}

/* Removes abandoned temporary files except `writer_temporary`, whose mtime is the current time. */
static void remove_stale(const struct target *target, const struct temporary *writer_temporary)
{
    const int folder_copy = openat(target->folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *entries = folder_copy >= 0 ? fdopendir(folder_copy) : NULL;
    struct stat info;
    if (!entries && folder_copy >= 0)
        close(folder_copy);
    if (!entries)
        return;
    const time_t now = fstat(writer_temporary->file, &info) == 0 ? info.st_mtime : 0;
    for (const struct dirent *entry; (entry = readdir(entries));) {
        if (is_temporary(entry->d_name, target->name) &&
            strcmp(entry->d_name, writer_temporary->name) != 0)
            remove_if_stale(target->folder, entry->d_name, now);
    }
    closedir(entries);
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

/* Closes a descriptor. Ignores EINTR, because Linux closes the descriptor nevertheless. */
static bool close_file(int file)
{
    return close(file) == 0 || errno == EINTR;
}

/* Syncs a folder, so that a rename is durable. Ignores EINVAL, which some file systems return. */
static bool sync_folder(int folder)
{
    return fsync(folder) == 0 || errno == EINVAL;
}

static enum status cannot_write(const char *path)
{
    log_error("%s: cannot be written: %s", path, strerror(errno));
    return STATUS_WRITE;
}

static enum status write_direct(const char *path, const void *data, size_t size)
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

/* Writes a temporary file and renames it over the target. Closes the file last, because closing
 * unlocks it and other processes may remove unlocked temporary files. */
static enum status replace(const struct target *target, const char *path, const void *data,
                           size_t size)
{
    struct temporary temporary;
    const int old_mode = find_mode(target);
    bool ok;

    if (!open_temporary(target, old_mode, &temporary))
        return cannot_create(path, strerror(errno));
    remove_stale(target, &temporary);
    ok = write_all(temporary.file, data, size);
    if (ok && old_mode >= 0)
        (void)fchmod(temporary.file, (mode_t)old_mode); /* some file systems have no modes */
    ok = ok && fsync(temporary.file) == 0;
    if (ok && !is_still_named(target->folder, temporary.name, temporary.file)) {
        log_error("%s: cannot be written: another program has replaced its temporary file", path);
        close(temporary.file);
        return STATUS_WRITE;
    }
    ok = ok && renameat(target->folder, temporary.name, target->folder, target->name) == 0;
    if (!ok) {
        const enum status status = cannot_write(path);
        remove_temporary(target, &temporary);
        return status;
    }
    ok = close_file(temporary.file) && sync_folder(target->folder);
    return ok ? STATUS_OK : cannot_write(path);
}

enum status file_io_write(const char *path, const void *data, size_t size)
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
    if (target.is_direct)
        status = write_direct(path, data, size);
    else
        status = replace(&target, path, data, size);
    target_finish(&target);
    return status;
}

bool file_io_is_direct(const char *path)
{
    struct stat info;
    return strcmp(path, "-") == 0 ||
           (stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode));
}

enum status file_io_check(const char *path)
{
    struct target target;
    enum status status;
    bool ok;

    if (strcmp(path, "-") == 0)
        return STATUS_OK;
    status = target_find(&target, path);
    if (status != STATUS_OK)
        return status;
    if (target.is_direct)
        ok = faccessat(AT_FDCWD, path, W_OK, AT_EACCESS) == 0;
    else
        ok = faccessat(target.folder, ".", W_OK | X_OK, AT_EACCESS) == 0;
    if (!ok)
        status = cannot_create(path, strerror(errno));
    target_finish(&target);
    return status;
}

enum status file_io_open(const char *path, FILE **file, int64_t *size)
{
    struct stat info;
    bool is_known;

    *size = 0;
    *file = fopen(path, "rb");
    is_known = *file && fstat(fileno(*file), &info) == 0;
    if (is_known && S_ISREG(info.st_mode)) {
        *size = info.st_size;
        return STATUS_OK;
    }
    log_error("%s: cannot be read: %s", path, is_known ? "not a regular file" : strerror(errno));
    if (*file)
        fclose(*file);
    *file = NULL;
    return STATUS_NO_INPUT;
}
