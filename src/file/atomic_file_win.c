/* atomic_file_win.c: writes output files atomically on Windows, by MoveFileEx(). */
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <windows.h>
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/file/atomic_file.h"

static const char *error_text(DWORD error, char text[static 256])
{
    const DWORD flags =
        FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS | FORMAT_MESSAGE_MAX_WIDTH_MASK;
    if (!FormatMessageA(flags, NULL, error, 0, text, 256, NULL))
        snprintf(text, 256, "error %lu", error);
    return text;
}

static enum status cannot_create(const char *path, const char *reason)
{
    log_error("%s: cannot be created: %s", path, reason);
    return STATUS_CANT_CREATE;
}

static enum status cannot_write(const char *path)
{
    char text[256];
    log_error("%s: cannot be written: %s", path, error_text(GetLastError(), text));
    return STATUS_WRITE;
}

static bool write_all(HANDLE file, const unsigned char *data, size_t size)
{
    while (size > 0) {
        const DWORD part = size < 1 << 30 ? (DWORD)size : 1 << 30;
        DWORD count = 0;
        if (!WriteFile(file, data, part, &count, NULL) || count == 0)
            return false;
        data += count;
        size -= count;
    }
    return true;
}

/* Writes the path of the folder that contains `path`. Returns false if it is too long. */
static bool find_folder(const char *path, char folder[static MAX_PATH])
{
    const char *end = path + strlen(path);
    while (end > path && end[-1] != '/' && end[-1] != '\\' && end[-1] != ':')
        end--;
    const int length = snprintf(folder, MAX_PATH, "%.*s", (int)(end - path), path);
    if (!length)
        snprintf(folder, MAX_PATH, ".");
    return length >= 0 && length < MAX_PATH;
}

static enum status write_direct(const char *path, const void *data, size_t size)
{
    const HANDLE file = CreateFileA(path, GENERIC_WRITE, 0, NULL, OPEN_EXISTING, 0, NULL);
    char text[256];
    if (file == INVALID_HANDLE_VALUE)
        return cannot_create(path, error_text(GetLastError(), text));
    const enum status status = write_all(file, data, size) ? STATUS_OK : cannot_write(path);
    (void)CloseHandle(file);
    return status;
}

/* Writes a temporary file and renames it over the target. */
static enum status replace(const char *path, const void *data, size_t size)
{
    char folder[MAX_PATH], temporary[MAX_PATH], text[256];
    if (!find_folder(path, folder))
        return cannot_create(path, "the path is too long");
    if (!GetTempFileNameA(folder, "frn", 0, temporary))
        return cannot_create(path, error_text(GetLastError(), text));
    const HANDLE file = CreateFileA(temporary, GENERIC_WRITE, 0, NULL, TRUNCATE_EXISTING, 0, NULL);
    if (file == INVALID_HANDLE_VALUE)
        return cannot_create(path, error_text(GetLastError(), text));
    const bool is_written = write_all(file, data, size) && FlushFileBuffers(file);
    const bool is_closed = CloseHandle(file);
    const DWORD flags = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
    if (is_written && is_closed && MoveFileExA(temporary, path, flags))
        return STATUS_OK;
    const enum status status = cannot_write(path);
    (void)DeleteFileA(temporary);
    return status;
}

/* Checks a path for which `kind` is known. */
static enum status check_path(const char *path, enum file_kind kind)
{
    const size_t length = strlen(path);
    if (kind == FILE_FOLDER)
        return cannot_create(path, "is a folder");
    if (length == 0 || strchr("/\\", path[length - 1]))
        return cannot_create(path, "has no file name");
    return STATUS_OK;
}

enum status file_io_write(const char *path, const void *data, size_t size)
{
    if (strcmp(path, "-") == 0) {
        const bool ok =
            fflush(stdout) == 0 && fwrite(data, 1, size, stdout) == size && fflush(stdout) == 0;
        return ok ? STATUS_OK : cannot_write("standard output");
    }
    const enum file_kind kind = file_info_of(path).kind;
    const enum status status = check_path(path, kind);
    if (status != STATUS_OK)
        return status;
    return kind == FILE_OTHER ? write_direct(path, data, size) : replace(path, data, size);
}

bool file_io_is_direct(const char *path)
{
    return strcmp(path, "-") == 0 || file_info_of(path).kind == FILE_OTHER;
}

enum status file_io_check(const char *path)
{
    char folder[MAX_PATH], temporary[MAX_PATH], text[256];
    if (strcmp(path, "-") == 0)
        return STATUS_OK;
    const enum file_kind kind = file_info_of(path).kind;
    const enum status status = check_path(path, kind);
    if (status != STATUS_OK || kind == FILE_OTHER)
        return status;
    if (!find_folder(path, folder))
        return cannot_create(path, "the path is too long");
    if (!GetTempFileNameA(folder, "frn", 0, temporary))
        return cannot_create(path, error_text(GetLastError(), text));
    (void)DeleteFileA(temporary);
    return STATUS_OK;
}

enum status file_io_open(const char *path, FILE **file, int64_t *size)
{
    *size = 0;
    *file = fopen(path, "rb");
    const int error = errno;
    const struct file_info info =
        *file ? file_info_of_open(*file) : (struct file_info){ .kind = FILE_MISSING };
    if (info.kind == FILE_REGULAR) {
        *size = info.size;
        return STATUS_OK;
    }
    log_error("%s: cannot be read: %s", path, *file ? "not a regular file" : strerror(error));
    if (*file)
        fclose(*file);
    *file = NULL;
    return STATUS_NO_INPUT;
}
