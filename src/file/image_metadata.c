/* image_metadata.c: adds planes and texts to image headers; compares and frees headers. */
#include "src/file/image_metadata.h"
#include <stdlib.h>
#include <string.h>

void image_header_finish(struct image_header *head)
{
    for (uint32_t i = 0; i < head->text_count; i++) {
        free(head->texts[i].name);
        free(head->texts[i].value);
    }
    image_finish(&head->image);
    *head = (struct image_header){ 0 };
}

bool image_header_add_plane(struct image_header *head, const char *name, bool half)
{
    struct image *image = &head->image;
    struct image_plane *planes =
        realloc(image->planes, (image->plane_count + 1) * sizeof(*image->planes));
    if (!planes)
        return false;
    image->planes = planes;
    struct image_plane *plane = &planes[image->plane_count++];
    *plane = (struct image_plane){ .half = half };
    strncpy(plane->name, name, sizeof(plane->name) - 1);
    return true;
}

bool image_header_add_text(struct image_header *head, const char *name, const char *value,
                           size_t value_length)
{
    static const char prefix[] = IMAGE_TEXT_PREFIX;
    if (strncmp(name, prefix, sizeof(prefix) - 1) != 0 || strlen(name) >= IMAGE_NAME_SIZE ||
        value_length >= IMAGE_TEXT_SIZE_MAX || memchr(value, '\0', value_length) ||
        head->text_count == IMAGE_TEXT_COUNT_MAX || image_header_text(head, name))
        return true;
    char *new_name = strdup(name), *new_value = malloc(value_length + 1);
    if (!new_name || !new_value) {
        free(new_name);
        free(new_value);
        return false;
    }
    memcpy(new_value, value, value_length);
    new_value[value_length] = '\0';
    head->texts[head->text_count].name = new_name;
    head->texts[head->text_count++].value = new_value;
    return true;
}

const char *image_header_text(const struct image_header *head, const char *name)
{
    for (uint32_t i = 0; i < head->text_count; i++) {
        if (strcmp(head->texts[i].name, name) == 0)
            return head->texts[i].value;
    }
    return NULL;
}

static bool has_plane(const struct image *image, const struct image_plane *wanted)
{
    for (uint32_t i = 0; i < image->plane_count; i++) {
        const struct image_plane *plane = &image->planes[i];
        if (strcmp(plane->name, wanted->name) == 0)
            return plane->half == wanted->half;
    }
    return false;
}

bool image_header_matches(const struct image_header *head, const struct image *image,
                          const struct image_text *texts, uint32_t text_count)
{
    bool same = head->image.width == image->width && head->image.height == image->height &&
                head->image.plane_count == image->plane_count;
    for (uint32_t i = 0; i < image->plane_count && same; i++)
        same = has_plane(&head->image, &image->planes[i]);
    for (uint32_t i = 0; i < text_count && same; i++) {
        const char *value = image_header_text(head, texts[i].name);
        same = value && strcmp(value, texts[i].value) == 0;
    }
    return same;
}
