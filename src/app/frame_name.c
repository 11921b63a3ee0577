/* frame_name.c: replaces the frame-number field of a file name. */
#include "src/app/frame_name.h"
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

enum {
    WIDTH_MAX = 32
};

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Returns the length of the "%d" or "%0Nd" at `text`, or 0 if there is none. Sets *width to N. */
static size_t measure_printf(const char *text, int *width)
{
    const char *at = text + 1;
    *width = 0;
    if (*at == '0') {
        for (at++; isdigit((unsigned char)*at) && *width <= WIDTH_MAX; at++)
            *width = 10 * *width + (*at - '0');
        if (*width < 1 || *width > WIDTH_MAX)
            return 0;
    }
    return *at == 'd' ? (size_t)(at + 1 - text) : 0;
}

enum status frame_name_parse(struct frame_name *name, const char *path)
{
    *name = (struct frame_name){ .path = path };
    for (const char *at = name_of(path); *(at += strcspn(at, "#%"));) {
        size_t length = strspn(at, "#");
        int width = (int)length;
        bool hashes = length > 0;
        if (!hashes)
            length = measure_printf(at, &width);
        if (!length) {
            log_error("--output: expected %%d or %%04d as the frame number, got '%s'", path);
            return STATUS_USAGE;
        }
        if (name->length || width > WIDTH_MAX) {
            log_error("--output: expected one frame number of at most %d digits, got '%s'",
                      WIDTH_MAX, path);
            return STATUS_USAGE;
        }
        name->at = (size_t)(at - path);
        name->length = length;
        name->width = width;
        name->hashes = hashes;
        at += length;
    }
    return STATUS_OK;
}

bool frame_name_is_pattern(const char *path)
{
    const char *name = name_of(path);
    int width;
    if (strstr(name, "##"))
        return true;
    for (const char *at = name; (at = strchr(at, '%')); at++) {
        if (measure_printf(at, &width))
            return true;
    }
    return false;
}

char *frame_name_make(const struct frame_name *name, int32_t frame)
{
    char number[WIDTH_MAX + 16] = "";
    int width = name->width + (name->hashes && frame < 0);
    if (name->length)
        snprintf(number, sizeof(number), "%0*d", width, (int)frame);
    size_t size = strlen(name->path) - name->length + strlen(number) + 1;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%.*s%s%s", (int)name->at, name->path, number,
                 name->path + name->at + name->length);
    return path;
}
