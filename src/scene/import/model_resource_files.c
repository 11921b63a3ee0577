/* model_resource_files.c: opens the files that a model refers to, confined to the model's folder.
 */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/scene/import/importer.h"

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
    const bool has_uri_scheme = is_uri && has_scheme(name);
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
    return !has_uri_scheme && !leads_outside(name);
}

char *model_file_join(const char *model, const char *name)
{
    const char *slash = strrchr(model, '/');
    const size_t folder = slash ? (size_t)(slash - model) + 1 : 0;
    const size_t length = strlen(name);
    char *path = malloc(folder + length + 1);
    if (path) {
        memcpy(path, model, folder);
        memcpy(path + folder, name, length + 1);
    }
    return path;
}

/* Returns the path of a file relative to the model's folder; the caller frees it. */
static char *local_name(const struct model_import *import, const char *path)
{
    const char *slash = strrchr(import->path, '/');
    const size_t folder = slash ? (size_t)(slash - import->path) + 1 : 0;
    return strdup(strncmp(path, import->path, folder) == 0 ? path + folder : path);
}

/* Opens a file within the model's folder for reading. If the path leaves the folder or cannot be
 * opened, stores the path in *import and returns NULL. */
static FILE *open_inside(struct model_import *import, const char *path)
{
    FILE *file = NULL;
    char *name = local_name(import, path);
    if (!name)
        return NULL;
    const bool is_inside = model_file_clean(name, false);
    if (!is_inside && import->refused_file[0] == '\0')
        snprintf(import->refused_file, sizeof(import->refused_file), "%s", path);
    /* Opens only regular files, because opening a named pipe would block. */
    if (is_inside && file_info_of(path).kind == FILE_REGULAR)
        file = fopen(path, "rb");
    if (is_inside && !file && import->missing_file[0] == '\0')
        snprintf(import->missing_file, sizeof(import->missing_file), "%s", name);
    free(name);
    return file;
}

FILE *model_file_open(void *user, const char *path)
{
    struct model_import *import = user;
    const bool is_model = strcmp(path, import->path) == 0; /* the model file may be anywhere */
    return is_model ? fopen(path, "rb") : open_inside(import, path);
}

const char *model_file_fault(const char *path)
{
    const enum file_kind kind = file_info_of(path).kind;
    if (kind == FILE_MISSING)
        return "file not found";
    if (kind != FILE_REGULAR)
        return "expected a regular file, not a folder, pipe or device";
    return file_is_link(path)
               ? "cannot be opened: expected a link to a file within the model's folder"
               : "cannot be opened: expected a readable file";
}
