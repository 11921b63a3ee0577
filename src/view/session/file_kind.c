/* file_kind.c: detects the kind of a file by its name or, for images, by its contents. */
#include "src/view/session/file_kind.h"
#include <string.h>
#include "src/base/path.h"
#include "src/file/image_receive.h"
#include "src/scene/environment/environment_image.h"
#include "src/scene/scene.h"

/* Returns true if an environment of this file is a panorama or a strip of cube faces. */
static bool has_panorama_shape(const struct image_header *head)
{
    const struct image_box frame = environment_image_frame(head);
    const uint64_t width = frame.width;
    const uint64_t height = frame.height;
    return environment_image_is_equirect(width, height) || height == 6 * width ||
           width == 6 * height;
}

/* Classifies a PNG file: a preset if it contains settings written by firn, otherwise an image. */
static enum status classify_png(const char *path, const struct reader_params *reader,
                                enum opened_kind *kind)
{
    struct image_header head;
    const enum status status = image_reader_check(&head, path, reader);
    if (status == STATUS_OK)
        *kind = image_header_text(&head, "firn/settings") ? FILE_KIND_PRESET : FILE_KIND_IMAGE;
    image_header_finish(&head);
    return status;
}

static enum status classify_image(const char *path, const struct reader_params *reader,
                                  enum opened_kind *kind)
{
    struct image_reader *image_reader;
    struct image_header head;
    const enum status status = image_reader_open(&image_reader, path, reader, &head);
    if (status == STATUS_OK)
        *kind = has_panorama_shape(&head) ? FILE_KIND_ENVIRONMENT : FILE_KIND_IMAGE;
    image_reader_close(image_reader);
    image_header_finish(&head);
    return status;
}

enum status file_kind_detect(const char *path, const struct reader_params *reader,
                             enum opened_kind *kind)
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
