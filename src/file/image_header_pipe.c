/* image_header_pipe.c: serialises the header of an image: counts, then plane names and metadata. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/image_receive.h"

enum {
    MAGIC_IMAGE = 0x504e5246,
};

struct text {
    char name[IMAGE_NAME_SIZE];
    uint32_t length; /* of the value, without '\0' */
};

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
    const uint32_t magic = MAGIC_IMAGE;
    const struct image *image = &head->image;
    return pipe_write(sink, &magic, sizeof(magic)) && pipe_write(sink, head, sizeof(*head)) &&
           pipe_write(sink, image->planes, image->plane_count * sizeof(*image->planes)) &&
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
        struct image_plane plane;
        const enum pipe_fault fault = pipe_read(source, &plane, sizeof(plane));
        if (fault != PIPE_OK)
            return fault;
        if (!memchr(plane.name, '\0', sizeof(plane.name)) || !pipe_is_bool(&plane.half) ||
            !pipe_is_bool(&plane.integer) || has_plane(&head->image, plane.name))
            return PIPE_TEXT;
        if (!image_header_add_plane(head, plane.name, plane.half))
            return PIPE_MEMORY;
        head->image.planes[p].integer = plane.integer;
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

/* Checks a received header, whose pointers are not used. */
static enum pipe_fault check_head(const struct image_header *head)
{
    const struct image *image = &head->image;
    const struct image_window *window = &head->window;
    if (!pipe_is_bool(&head->has_window) || !pipe_is_bool(&head->has_world_to_camera) ||
        !pipe_is_bool(&head->has_world_to_ndc) || !pipe_is_bool(&head->is_cube_map) ||
        !pipe_is_bool(&head->is_latlong))
        return PIPE_HEAD;
    if (image->width < 1 || image->width > IMAGE_MAX_SIDE || image->height < 1 ||
        image->height > IMAGE_MAX_SIDE || image->width > IMAGE_MAX_TEXELS / image->height ||
        image->plane_count < 1 || image->plane_count > IMAGE_MAX_PLANES ||
        image->width * image->height > IMAGE_MAX_SAMPLES / image->plane_count ||
        head->text_count > IMAGE_TEXT_COUNT_MAX)
        return PIPE_SIZE;
    if (head->has_window &&
        (window->x > window->width || window->y > window->height ||
         image->width > window->width - window->x || image->height > window->height - window->y))
        return PIPE_SIZE;
    for (size_t i = 0; i < 16; i++) {
        if ((head->has_world_to_camera && !isfinite(head->world_to_camera[i])) ||
            (head->has_world_to_ndc && !isfinite(head->world_to_ndc[i])))
            return PIPE_NUMBER;
    }
    return PIPE_OK;
}

enum pipe_fault image_pipe_read_header(const struct pipe_source *source, struct image_header *head)
{
    uint32_t magic;
    struct image_header sent;
    *head = (struct image_header){ 0 };
    enum pipe_fault fault = pipe_read(source, &magic, sizeof(magic));
    if (fault == PIPE_OK && magic != MAGIC_IMAGE)
        fault = PIPE_HEAD;
    if (fault == PIPE_OK)
        fault = pipe_read(source, &sent, sizeof(sent));
    if (fault == PIPE_OK)
        fault = check_head(&sent);
    if (fault != PIPE_OK)
        return fault;
    image_init(&head->image, sent.image.width, sent.image.height);
    head->has_window = sent.has_window;
    head->has_world_to_camera = sent.has_world_to_camera;
    head->has_world_to_ndc = sent.has_world_to_ndc;
    head->window = sent.window;
    head->data_window = sent.data_window;
    head->display_window = sent.display_window;
    head->is_cube_map = sent.is_cube_map;
    head->is_latlong = sent.is_latlong;
    memcpy(head->world_to_camera, sent.world_to_camera, sizeof(sent.world_to_camera));
    memcpy(head->world_to_ndc, sent.world_to_ndc, sizeof(sent.world_to_ndc));
    fault = read_planes(source, sent.image.plane_count, head);
    for (uint32_t i = 0; i < sent.text_count && fault == PIPE_OK; i++)
        fault = read_text(source, head);
    if (fault != PIPE_OK)
        image_header_finish(head);
    return fault;
}
