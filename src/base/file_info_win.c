/* file_info_win.c: kind, size and identity of files by the Windows API. */
#include <errno.h>
#include <io.h>
#include <stdint.h>
#include <windows.h>
#include "src/base/file_info.h"

static struct file_info describe(HANDLE handle)
{
    BY_HANDLE_FILE_INFORMATION info;
    struct file_info described = { .kind = FILE_OTHER };
    if (GetFileType(handle) != FILE_TYPE_DISK || !GetFileInformationByHandle(handle, &info))
        return described;
    described.kind = info.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY ? FILE_FOLDER : FILE_REGULAR;
    described.size = (int64_t)((uint64_t)info.nFileSizeHigh << 32 | info.nFileSizeLow);
    described.volume = info.dwVolumeSerialNumber;
    described.index = (uint64_t)info.nFileIndexHigh << 32 | info.nFileIndexLow;
    return described;
}

struct file_info file_info_of(const char *path)
{
    const DWORD shares = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    const HANDLE handle = CreateFileA(path, FILE_READ_ATTRIBUTES, shares, NULL, OPEN_EXISTING,
                                      FILE_FLAG_BACKUP_SEMANTICS, NULL);
    if (handle == INVALID_HANDLE_VALUE) {
        const DWORD error = GetLastError();
        const bool is_missing = error == ERROR_FILE_NOT_FOUND || error == ERROR_PATH_NOT_FOUND ||
                                error == ERROR_INVALID_NAME;
        errno = is_missing ? ENOENT : EACCES;
        return (struct file_info){ .kind = FILE_MISSING };
    }
    const struct file_info info = describe(handle);
    (void)CloseHandle(handle);
    return info;
}

struct file_info file_info_of_open(FILE *file)
{
    const HANDLE handle = (HANDLE)_get_osfhandle(_fileno(file));
    return handle == INVALID_HANDLE_VALUE ? (struct file_info){ .kind = FILE_MISSING }
                                          : describe(handle);
}

bool file_is_link(const char *path)
{
    const DWORD attributes = GetFileAttributesA(path);
    return attributes != INVALID_FILE_ATTRIBUTES && attributes & FILE_ATTRIBUTE_REPARSE_POINT;
}

bool file_is_readable(const char *path)
{
    enum {
        READABLE = 4
    };

    return _access(path, READABLE) == 0;
}

bool file_seek(FILE *file, int64_t offset)
{
    return _fseeki64(file, offset, SEEK_SET) == 0;
}
