/* file_kind.c: detects the kind of a file by its name or, for images, by its contents. */
#include "src/view/session/file_kind.h"
#include <string.h>
#include "src/base/path.h"
#include "src/file/image_receive.h"
#include "src/scene/environment/cube_to_equirect.h"
#include "src/scene/scene.h"

/* Returns true if the aspect ratio is 2:1 (panorama), 6:1 or 1:6 (strip of cube faces). */
static bool has_panorama_shape(const struct image *image)
{
    const uint64_t width = image->width;
    const uint64_t height = image->height;
    return width == 2 * height || height == 6 * width || width == 6 * height;
}

/* Returns true if the aspect ratio is that of a cube map laid out as a cross (4:3 or 3:4). */
static bool has_cross_shape(const struct image *image)
{
    const uint64_t width = image->width;
    const uint64_t height = image->height;
    return 3 * width == 4 * height || 4 * width == 3 * height;
}

/* Decodes an image to find out whether it is a cube map with black texels around a cross. */
static enum status detect_cross(const char *path, const struct reader_params *reader,
                                enum file_kind *kind)
{
    struct image image = { 0 };
    const enum status status = image_reader_read(&image, path, reader);
    if (status == STATUS_OK)
        *kind =
            panorama_detect_cube(&image) == PANORAMA_NONE ? FILE_KIND_IMAGE : FILE_KIND_ENVIRONMENT;
    image_finish(&image);
    return status;
}

/* Classifies a PNG file: a preset if it contains settings written by firn, otherwise an image. */
static enum status classify_png(const char *path, const struct reader_params *reader,
                                enum file_kind *kind)
{
    struct image_header head;
    const enum status status = image_reader_check(&head, path, reader);
    if (status == STATUS_OK)
        *kind = image_header_text(&head, "firn/settings") ? FILE_KIND_PRESET : FILE_KIND_IMAGE;
    image_header_finish(&head);
    return status;
}

static enum status classify_image(const char *path, const struct reader_params *reader,
                                  enum file_kind *kind)
{
    struct image_reader *image_reader;
    struct image_header head;
    bool may_be_cross = false;
    const enum status status = image_reader_open(&image_reader, path, reader, &head);
    if (status == STATUS_OK) {
        *kind = has_panorama_shape(&head.image) ? FILE_KIND_ENVIRONMENT : FILE_KIND_IMAGE;
        may_be_cross = has_cross_shape(&head.image) && !image_header_text(&head, "firn/settings");
    }
    image_reader_close(image_reader);
    image_header_finish(&head);
    return may_be_cross ? detect_cross(path, reader, kind) : status;
}

enum status file_kind_detect(const char *path, const struct reader_params *reader,
                             enum file_kind *kind)
{
    if (scene_is_environment(path))
        *kind = FILE_KIND_ENVIRONMENT;
    else if (path_ends_in(path, ".firn"))
        *kind = FILE_KIND_SESSION;
    else if (path_ends_in(path, ".txt"))
        *kind = FILE_KIND_PRESET;
    else if (path_ends_in(path, ".png"))
        return classify_png(path, reader, kind);
    else if (image_reader_knows_suffix(path))
        return classify_image(path, reader, kind);
    else
        *kind = FILE_KIND_MODEL;
    return STATUS_OK;
}
