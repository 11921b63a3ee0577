/* drop.c: detects the kind of an opened or dropped file: by its name or, for images, the contents.
 */
#include "src/view/drop.h"
#include <string.h>
#include "src/base/path.h"
#include "src/reader/picture_reader.h"
#include "src/scene/panorama.h"
#include "src/scene/scene.h"

/* Returns true for the aspect ratio of a panorama (2:1) or of six cube faces in a strip. */
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

/* Detects a cube map as a cross: all else is black, so every texel has to be decoded. */
static enum status detect_cross(const char *path, const struct reader_params *reader,
                                enum drop *drop)
{
    struct image image = { 0 };
    const enum status status = picture_read(&image, path, reader);
    if (status == STATUS_OK)
        *drop = panorama_find(&image) == PANORAMA_NONE ? DROP_PICTURE : DROP_ENVIRONMENT;
    image_finish(&image);
    return status;
}

/* Classifies a PNG file: a preset if firn stored its settings in it, otherwise an image. */
static enum status classify_png(const char *path, const struct reader_params *reader,
                                enum drop *drop)
{
    struct picture_head head;
    const enum status status = picture_check(&head, path, reader);
    if (status == STATUS_OK)
        *drop = picture_head_text(&head, "firn/settings") ? DROP_PRESET : DROP_PICTURE;
    picture_head_finish(&head);
    return status;
}

static enum status classify_image(const char *path, const struct reader_params *reader,
                                  enum drop *drop)
{
    struct picture_reader *picture;
    struct picture_head head;
    bool may_be_cross = false;
    const enum status status = picture_open(&picture, path, reader, &head);
    if (status == STATUS_OK) {
        *drop = has_panorama_shape(&head.image) ? DROP_ENVIRONMENT : DROP_PICTURE;
        may_be_cross = has_cross_shape(&head.image) && !picture_head_text(&head, "firn/settings");
    }
    picture_close(picture);
    picture_head_finish(&head);
    return may_be_cross ? detect_cross(path, reader, drop) : status;
}

enum status drop_find(const char *path, const struct reader_params *reader, enum drop *drop)
{
    if (scene_is_environment(path))
        *drop = DROP_ENVIRONMENT;
    else if (path_ends_in(path, ".firn"))
        *drop = DROP_SESSION;
    else if (path_ends_in(path, ".txt"))
        *drop = DROP_PRESET;
    else if (path_ends_in(path, ".png"))
        return classify_png(path, reader, drop);
    else if (picture_is_named(path))
        return classify_image(path, reader, drop);
    else
        *drop = DROP_MODEL;
    return STATUS_OK;
}
