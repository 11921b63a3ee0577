/* hdr.c: reads Radiance .hdr files with stb_image, adding checks for truncated files. */
#include "src/file/hdr.h"
#include <errno.h>
#include <stb/stb_image.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/atomic_file.h"

struct source {
    FILE *file;
    bool ended;   /* a read was short */
    bool overrun; /* stb_image read beyond the file's end */
};

/*
 * Reads for stb_image, with line feeds beyond the end of the file, which terminate all of its loops
 * (an empty header line, a run longer than 0). With zeros, truncation would go unnoticed, and its
 * run-length decoder would not terminate. Its large buffered reads may be short at the end; a read
 * of a single texel (4 bytes) must not be.
 */
static int source_read(void *user, char *data, int size)
{
    struct source *source = user;
    const size_t wanted = (size_t)size;
    const size_t count = fread(data, 1, wanted, source->file);

    if (count == wanted)
        return size;
    source->ended = true;
    if (count > 0 && wanted > 4)
        return (int)count;
    source->overrun = true;
    memset(data + count, '\n', wanted - count);
    return size;
}

static void source_skip(void *user, int count)
{
    struct source *source = user;
    if (fseek(source->file, count, SEEK_CUR) != 0)
        source->ended = true;
}

static int source_eof(void *user)
{
    const struct source *source = user;
    return source->ended;
}

static const stbi_io_callbacks callbacks = { source_read, source_skip, source_eof };

static void source_rewind(struct source *source)
{
    rewind(source->file);
    source->ended = false;
    source->overrun = false;
}

/* Returns the smallest possible size in bytes of the run-length encoded texels. */
static int64_t min_size(int width, int height)
{
    const int64_t row =
        width < 8 || width >= 32768 ? 4 * (int64_t)width : 4 + 8 * (((int64_t)width + 126) / 127);
    return row * height;
}

/* Returns a message that describes the fault of an invalid header, or NULL if it is valid. */
static const char *find_fault(struct source *source, int64_t file_size, int *width, int *height)
{
    int channels;

    source_rewind(source);
    if (!stbi_is_hdr_from_callbacks(&callbacks, source))
        return "not a Radiance HDR file";
    source_rewind(source);
    if (!stbi_info_from_callbacks(&callbacks, source, width, height, &channels))
        return "the header is damaged or not supported";
    if (*width <= 0 || *width > IMAGE_MAX_SIDE || *height <= 0 || *height > IMAGE_MAX_SIDE ||
        *width > IMAGE_MAX_TEXELS / *height)
        return "the size is out of range";
    if (file_size < min_size(*width, *height))
        return "the file is truncated";
    return NULL;
}

static bool fill_image(struct image *image, const float *texels, int width, int height)
{
    static const char names[3][2] = { "R", "G", "B" };
    const size_t count = (size_t)width * (size_t)height;

    image_init(image, (uint32_t)width, (uint32_t)height);
    for (size_t c = 0; c < 3; c++) {
        float *plane = image_add_plane(image, names[c], false);
        if (!plane) {
            image_finish(image);
            return false;
        }
        for (size_t i = 0; i < count; i++)
            plane[i] = texels[3 * i + c];
    }
    return true;
}

static enum status reject(const struct source *source, const char *path, const char *fault)
{
    if (ferror(source->file)) {
        log_error("%s: cannot be read: %s", path, strerror(EIO));
        return STATUS_NO_INPUT;
    }
    log_error("%s: %s", path, fault);
    return STATUS_DATA;
}

static enum status read_texels(const char *path, struct source *source, struct image *image)
{
    int width, height, channels;
    enum status status = STATUS_OK;
    source_rewind(source);
    float *texels = stbi_loadf_from_callbacks(&callbacks, source, &width, &height, &channels, 3);
    if (source->overrun)
        status = reject(source, path, "the file is truncated");
    else if (!texels && strcmp(stbi_failure_reason(), "outofmem") != 0)
        status = reject(source, path, stbi_failure_reason());
    else if (!texels || !fill_image(image, texels, width, height))
        status = log_out_of_memory(path);
    stbi_image_free(texels);
    return status;
}

enum status hdr_read(const char *path, struct image *image, image_size_fn *begin, void *user)
{
    struct source source = { 0 };
    int64_t file_size;
    int width = 0, height = 0;
    enum status status = file_io_open(path, &source.file, &file_size);
    if (status != STATUS_OK)
        return status;
    const char *fault = find_fault(&source, file_size, &width, &height);
    if (fault)
        status = reject(&source, path, fault);
    else if (begin)
        status = begin(user, (uint32_t)width, (uint32_t)height, 3);
    if (status == STATUS_OK)
        status = read_texels(path, &source, image);
    fclose(source.file);
    return status;
}
