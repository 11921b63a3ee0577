/* image_header_pipe.c: serialises the header of an image: counts, then plane names and metadata. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/image_receive.h"

enum {
    MAGIC_IMAGE = 0x504e5246,
    HAS_WINDOW = 1,
    HAS_WORLD_TO_CAMERA = 2,
    HAS_WORLD_TO_NDC = 4,
};

struct head {
    uint32_t magic, flags;
    uint32_t width, height;
    uint32_t plane_count, text_count;
    struct image_window window;
    float world_to_camera[16], world_to_ndc[16];
};

struct plane {
    char name[IMAGE_NAME_SIZE];
    uint32_t half; /* 0 or 1 */
};

struct text {
    char name[IMAGE_NAME_SIZE];
    uint32_t length; /* of the value, without '\0' */
};

_Static_assert(sizeof(struct head) == 168 && sizeof(struct plane) == 68 &&
                   sizeof(struct text) == 68,
               "no padding, so no bytes of this process in them");

static bool write_planes(const struct pipe_sink *sink, const struct image *image)
{
    bool done = true;
    for (uint32_t p = 0; p < image->plane_count && done; p++) {
        struct plane plane = { .half = image->planes[p].half };
        memcpy(plane.name, image->planes[p].name, sizeof(plane.name));
        done = pipe_write(sink, &plane, sizeof(plane));
    }
    return done;
}

static bool write_texts(const struct pipe_sink *sink, const struct image_header *head)
{
    bool done = true;
    for (uint32_t i = 0; i < head->text_count && done; i++) {
        const char *value = head->texts[i].value;
        struct text text = { .length = (uint32_t)strlen(value) };
        strncpy(text.name, head->texts[i].name, sizeof(text.name) - 1);
        done = pipe_write(sink, &text, sizeof(text)) && pipe_write(sink, value, text.length);
    }
    return done;
}

bool image_pipe_write_header(const struct pipe_sink *sink, const struct image_header *head)
{
    struct head sent = {
        .magic = MAGIC_IMAGE,
        .flags = (head->has_window ? HAS_WINDOW : 0u) |
                 (head->has_world_to_camera ? HAS_WORLD_TO_CAMERA : 0u) |
                 (head->has_world_to_ndc ? HAS_WORLD_TO_NDC : 0u),
        .width = head->image.width,
        .height = head->image.height,
        .plane_count = head->image.plane_count,
        .text_count = head->text_count,
        .window = head->window,
    };
    memcpy(sent.world_to_camera, head->world_to_camera, sizeof(sent.world_to_camera));
    memcpy(sent.world_to_ndc, head->world_to_ndc, sizeof(sent.world_to_ndc));
    return pipe_write(sink, &sent, sizeof(sent)) && write_planes(sink, &head->image) &&
           write_texts(sink, head);
}

static bool has_plane(const struct image *image, const char *name)
{
    for (uint32_t p = 0; p < image->plane_count; p++) {
        if (strcmp(image->planes[p].name, name) == 0)
            return true;
    }
    return false;
}

static enum pipe_fault read_planes(const struct pipe_source *source, uint32_t count,
                                   struct image_header *head)
{
    for (uint32_t p = 0; p < count; p++) {
        struct plane plane;
        const enum pipe_fault fault = pipe_read(source, &plane, sizeof(plane));
        if (fault != PIPE_OK)
            return fault;
        if (!memchr(plane.name, '\0', sizeof(plane.name)) || plane.half > 1 ||
            has_plane(&head->image, plane.name))
            return PIPE_TEXT;
        if (!image_header_add_plane(head, plane.name, plane.half))
            return PIPE_MEMORY;
    }
    return PIPE_OK;
}

static enum pipe_fault read_text(const struct pipe_source *source, struct image_header *head)
{
    struct text text;
    enum pipe_fault fault = pipe_read(source, &text, sizeof(text));
    if (fault != PIPE_OK)
        return fault;
    if (!memchr(text.name, '\0', sizeof(text.name)) || text.length >= IMAGE_TEXT_SIZE_MAX)
        return PIPE_TEXT;
    char *value = malloc(text.length + 1);
    if (!value)
        return PIPE_MEMORY;
    const uint32_t count = head->text_count;
    fault = pipe_read(source, value, text.length);
    if (fault == PIPE_OK && !image_header_add_text(head, text.name, value, text.length))
        fault = PIPE_MEMORY;
    else if (fault == PIPE_OK && head->text_count == count)
        fault = PIPE_TEXT;
    free(value);
    return fault;
}

static enum pipe_fault check_numbers(const struct head *head)
{
    for (size_t i = 0; i < 16; i++) {
        if ((head->flags & HAS_WORLD_TO_CAMERA && !isfinite(head->world_to_camera[i])) ||
            (head->flags & HAS_WORLD_TO_NDC && !isfinite(head->world_to_ndc[i])))
            return PIPE_NUMBER;
    }
    return PIPE_OK;
}

static enum pipe_fault check_head(const struct head *head)
{
    const struct image_window *window = &head->window;
    if (head->magic != MAGIC_IMAGE ||
        head->flags & ~(uint32_t)(HAS_WINDOW | HAS_WORLD_TO_CAMERA | HAS_WORLD_TO_NDC))
        return PIPE_HEAD;
    if (head->width < 1 || head->width > IMAGE_MAX_SIDE || head->height < 1 ||
        head->height > IMAGE_MAX_SIDE || head->width > IMAGE_MAX_TEXELS / head->height ||
        head->plane_count < 1 || head->plane_count > IMAGE_MAX_PLANES ||
        head->width * head->height > IMAGE_MAX_SAMPLES / head->plane_count ||
        head->text_count > IMAGE_TEXT_COUNT_MAX)
        return PIPE_SIZE;
    if (head->flags & HAS_WINDOW &&
        (window->x > window->width || window->y > window->height ||
         head->width > window->width - window->x || head->height > window->height - window->y))
        return PIPE_SIZE;
    return check_numbers(head);
}

enum pipe_fault image_pipe_read_header(const struct pipe_source *source, struct image_header *head)
{
    struct head sent;
    *head = (struct image_header){ 0 };
    enum pipe_fault fault = pipe_read(source, &sent, sizeof(sent));
    if (fault == PIPE_OK)
        fault = check_head(&sent);
    if (fault != PIPE_OK)
        return fault;
    image_init(&head->image, sent.width, sent.height);
    head->has_window = sent.flags & HAS_WINDOW;
    head->has_world_to_camera = sent.flags & HAS_WORLD_TO_CAMERA;
    head->has_world_to_ndc = sent.flags & HAS_WORLD_TO_NDC;
    head->window = sent.window;
    memcpy(head->world_to_camera, sent.world_to_camera, sizeof(sent.world_to_camera));
    memcpy(head->world_to_ndc, sent.world_to_ndc, sizeof(sent.world_to_ndc));
    fault = read_planes(source, sent.plane_count, head);
    for (uint32_t i = 0; i < sent.text_count && fault == PIPE_OK; i++)
        fault = read_text(source, head);
    if (fault != PIPE_OK)
        image_header_finish(head);
    return fault;
}
