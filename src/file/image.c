/* image.c: in-memory images as named planes of floats, and headers of image files. */
#include "src/file/image.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

void image_init(struct image *image, uint32_t width, uint32_t height)
{
    *image = (struct image){ .width = width, .height = height };
}

bool image_init_like(struct image *image, const struct image *like, uint32_t height)
{
    bool done = true;
    image_init(image, like->width, height);
    for (uint32_t p = 0; p < like->plane_count && done; p++) {
        done = image_add_plane(image, like->planes[p].name, like->planes[p].half);
        if (done)
            image->planes[p].integer = like->planes[p].integer;
    }
    return done;
}

void image_finish(struct image *image)
{
    for (uint32_t i = 0; i < image->plane_count + image->spare_count; i++)
        free(image->planes[i].texels);
    free(image->planes);
    *image = (struct image){ 0 };
}

void image_clear(struct image *image, uint32_t width, uint32_t height)
{
    if (image->width != width || image->height != height)
        image_finish(image);
    image->width = width;
    image->height = height;
    image->spare_count += image->plane_count;
    image->plane_count = 0;
}

/* Returns zeroed texels for the next plane, spare ones if there are any; NULL if out of memory. */
static float *next_texels(struct image *image)
{
    const size_t count = (size_t)image->width * image->height;
    if (image->spare_count) {
        image->spare_count--;
        return memset(image->planes[image->plane_count].texels, 0, count * sizeof(float));
    }
    struct image_plane *planes = realloc(image->planes, (image->plane_count + 1) * sizeof(*planes));
    if (!planes)
        return NULL;
    image->planes = planes;
    return calloc(count, sizeof(float));
}

float *image_add_plane(struct image *image, const char *name, bool half)
{
    assert(image->width > 0 && image->height > 0);
    assert(strlen(name) < IMAGE_NAME_SIZE && !image_find(image, name));
    if (image->width > SIZE_MAX / sizeof(float) / image->height)
        return NULL;
    float *texels = next_texels(image);
    if (!texels)
        return NULL;
    struct image_plane *plane = &image->planes[image->plane_count++];
    *plane = (struct image_plane){ .half = half, .texels = texels };
    strncpy(plane->name, name, IMAGE_NAME_SIZE - 1);
    return texels;
}

float *image_find(const struct image *image, const char *name)
{
    for (uint32_t i = 0; i < image->plane_count; i++) {
        if (strcmp(image->planes[i].name, name) == 0)
            return image->planes[i].texels;
    }
    return NULL;
}

/* ---- headers of image files ---- */

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
            return plane->half == wanted->half && plane->integer == wanted->integer;
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
