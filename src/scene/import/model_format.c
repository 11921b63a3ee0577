/* model_format.c: detects the format of a model file by its suffix, and checks its first bytes. */
#include <stdio.h>
#include <string.h>
#include "src/base/ascii.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/scene/import/importer.h"

enum {
    HEAD_SIZE = 4096, /* bytes to check at the start */
};

/* Returns the first non-blank character, after an optional UTF-8 byte order mark. */
static const char *skip_blanks(const char *text)
{
    if (strncmp(text, "\xef\xbb\xbf", 3) == 0)
        text += 3;
    return text + strspn(text, " \t\r\n");
}

static bool is_glb(const char *head, size_t size)
{
    return size >= 12 && memcmp(head, "glTF", 4) == 0;
}

static bool is_gltf(const char *head, size_t size)
{
    (void)size;
    return *skip_blanks(head) == '{';
}

static bool is_ply(const char *head, size_t size)
{
    (void)size;
    return strncmp(head, "ply", 3) == 0 && (head[3] == '\n' || head[3] == '\r');
}

/* Binary STL has no mark: the reader compares the facet count with the file's size. */
static bool is_stl(const char *head, size_t size)
{
    return size >= 84 || ascii_begins_equal(skip_blanks(head), "solid", 5);
}

/* Returns true for any text, because OBJ has no signature. */
static bool is_obj(const char *head, size_t size)
{
    return !memchr(head, '\0', size);
}

static const struct format {
    struct model_format format;
    bool (*has_head)(const char *head, size_t size); /* `head` is terminated by '\0' */
} formats[] = {
    { { "gltf", "glTF", .is_gltf = true }, is_gltf },
    { { "glb", "binary glTF", .is_gltf = true }, is_glb },
    { { "obj", "OBJ" }, is_obj },
    { { "ply", "PLY" }, is_ply },
    { { "stl", "STL" }, is_stl },
};

/* Formats that other programs can convert to glTF. */
static const struct {
    const char *suffix, *name;
} unread[] = {
    { ".usd", "USD" },     { ".usda", "USD" },      { ".usdc", "USD" },    { ".usdz", "USD" },
    { ".fbx", "FBX" },     { ".blend", "Blender" }, { ".dae", "Collada" }, { ".3ds", "3DS" },
    { ".step", "STEP" },   { ".stp", "STEP" },      { ".iges", "IGES" },   { ".igs", "IGES" },
    { ".3mf", "3MF" },     { ".abc", "Alembic" },   { ".x3d", "X3D" },     { ".wrl", "VRML" },
    { ".max", "3ds Max" }, { ".ma", "Maya" },       { ".mb", "Maya" },     { ".c4d", "Cinema 4D" },
};

static enum status check_head(const char *path, const struct format *format)
{
    char head[HEAD_SIZE + 1];
    FILE *file = fopen(path, "rb");
    const size_t size = file ? fread(head, 1, HEAD_SIZE, file) : 0;
    const bool failed = !file || ferror(file);
    if (file)
        fclose(file);
    if (failed) {
        log_error("%s: cannot be read", path);
        return STATUS_NO_INPUT;
    }
    head[size] = '\0';
    if (format->has_head(head, size))
        return STATUS_OK;
    log_error("%s: the contents are not %s: export the file again, or correct its suffix", path,
              format->format.name);
    return STATUS_DATA;
}

enum status model_format_find(const char *path, const struct model_format **format)
{
    for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
        char end[8];
        snprintf(end, sizeof(end), ".%s", formats[i].format.suffix);
        if (!path_ends_in(path, end))
            continue;
        *format = &formats[i].format;
        return check_head(path, &formats[i]);
    }
    for (size_t i = 0; i < sizeof(unread) / sizeof(unread[0]); i++) {
        if (!path_ends_in(path, unread[i].suffix))
            continue;
        log_error("%s: %s files cannot be read: export the model as glTF (.glb)", path,
                  unread[i].name);
        return STATUS_DATA;
    }
    log_error("%s: unknown model format; expected .gltf, .glb, .obj, .ply or .stl", path);
    return STATUS_DATA;
}
