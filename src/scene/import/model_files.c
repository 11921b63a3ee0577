/* model_files.c: which files a model may name, and how assimp opens them. */
#include <assimp/cfileio.h>
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include "src/base/log.h"
#include "src/scene/import/model_import.h"

static int hex_digit(char c)
{
    const char *digits = "0123456789abcdef";
    const char *found = c ? strchr(digits, c | 0x20) : NULL;
    return found ? (int)(found - digits) : -1;
}

static bool has_scheme(const char *name)
{
    const char *c = name;
    while (isalnum((unsigned char)*c) || (c > name && (*c == '+' || *c == '-' || *c == '.')))
        c++;
    return c > name && *c == ':';
}

static bool leads_outside(const char *name)
{
    if (name[0] == '/' || strstr(name, "://"))
        return true;
    for (const char *part = name; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0'))
            return true;
    }
    return false;
}

bool model_file_clean(char *name, bool is_uri)
{
    const bool is_elsewhere = is_uri && has_scheme(name);
    char *to = name;
    for (const char *from = name; *from; from++) {
        int high = is_uri && *from == '%' ? hex_digit(from[1]) : -1;
        int low = high >= 0 ? hex_digit(from[2]) : -1;
        char c = *from;
        if (low >= 0) {
            c = (char)(high * 16 + low);
            from += 2;
        }
        *to++ = (char)(c == '\\' ? '/' : c);
    }
    *to = '\0';
    return !is_elsewhere && !leads_outside(name);
}

/* Returns the path of a file relative to the model's folder; the caller frees it. */
static char *local_name(const struct model_import *import, const char *path)
{
    const char *slash = strrchr(import->path, '/');
    const size_t folder = slash ? (size_t)(slash - import->path) + 1 : 0;
    return strdup(strncmp(path, import->path, folder) == 0 ? path + folder : path);
}

static size_t read_file(struct aiFile *file, char *bytes, size_t size, size_t count)
{
    return fread(bytes, size, count, (FILE *)file->UserData);
}

static size_t write_file(struct aiFile *file, const char *bytes, size_t size, size_t count)
{
    (void)file;
    (void)bytes;
    (void)size;
    (void)count;
    return 0;
}

static size_t tell_file(struct aiFile *file)
{
    const long at = ftell((FILE *)file->UserData);
    return at < 0 ? 0 : (size_t)at;
}

static size_t size_file(struct aiFile *file)
{
    struct stat info;
    return fstat(fileno((FILE *)file->UserData), &info) == 0 ? (size_t)info.st_size : 0;
}

static enum aiReturn seek_file(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    static const int whence[] = {
        [aiOrigin_SET] = SEEK_SET,
        [aiOrigin_CUR] = SEEK_CUR,
        [aiOrigin_END] = SEEK_END,
    };
    if ((size_t)origin >= sizeof(whence) / sizeof(whence[0]))
        return aiReturn_FAILURE;
    return fseek((FILE *)file->UserData, (long)offset, whence[origin]) == 0 ? aiReturn_SUCCESS
                                                                            : aiReturn_FAILURE;
}

static void flush_file(struct aiFile *file)
{
    (void)file;
}

/* Whether the model may name a file; if not, notes it. */
static bool is_allowed(struct model_import *import, const char *path)
{
    struct stat info;
    char *name = local_name(import, path);
    if (!name)
        return false;
    /* For a missing file assimp tries again, with a slash or the folder before the name. */
    const bool again = import->misses_file && name[0] == '/';
    const bool is_inside = !again && model_file_clean(name, import->is_gltf);
    if (!again && !is_inside && import->refused[0] == '\0')
        snprintf(import->refused, sizeof(import->refused), "%s", path);
    free(name);
    /* Only regular files are opened: opening a pipe would wait for its other end. */
    const bool is_there = is_inside && stat(path, &info) == 0 && S_ISREG(info.st_mode);
    import->misses_file = import->misses_file || (is_inside && !is_there);
    return is_there;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode)
{
    struct model_import *import = (struct model_import *)io->UserData;
    if (mode[0] != 'r' || !is_allowed(import, path))
        return NULL;
    struct aiFile *file = malloc(sizeof(*file));
    FILE *opened = file ? fopen(path, "rb") : NULL;
    if (!opened) {
        free(file);
        return NULL;
    }
    *file = (struct aiFile){
        .ReadProc = read_file,
        .WriteProc = write_file,
        .TellProc = tell_file,
        .FileSizeProc = size_file,
        .SeekProc = seek_file,
        .FlushProc = flush_file,
        .UserData = (aiUserData)opened,
    };
    return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    if (!file)
        return;
    fclose((FILE *)file->UserData);
    free(file);
}

struct aiFileIO model_file_io(struct model_import *import)
{
    return (struct aiFileIO){
        .OpenProc = open_file,
        .CloseProc = close_file,
        .UserData = (aiUserData)import,
    };
}
