/* file_info_posix.c: kind, size and identity of files by stat(). */
#include <sys/stat.h>
#include <unistd.h>
#include "src/base/file_info.h"

static struct file_info describe(const struct stat *info)
{
    return (struct file_info){
        .kind = S_ISREG(info->st_mode)   ? FILE_REGULAR
                : S_ISDIR(info->st_mode) ? FILE_FOLDER
                                         : FILE_OTHER,
        .size = info->st_size,
        .volume = info->st_dev,
        .index = info->st_ino,
    };
}

struct file_info file_info_of(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 ? describe(&info) : (struct file_info){ .kind = FILE_MISSING };
}

struct file_info file_info_of_open(FILE *file)
{
    struct stat info;
    return fstat(fileno(file), &info) == 0 ? describe(&info)
                                           : (struct file_info){ .kind = FILE_MISSING };
}

bool file_is_link(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0 && S_ISLNK(info.st_mode);
}

bool file_is_readable(const char *path)
{
    return access(path, R_OK) == 0;
}

bool file_seek(FILE *file, int64_t offset)
{
    return fseeko(file, (off_t)offset, SEEK_SET) == 0;
}
