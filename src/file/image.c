/* image.c: in-memory images as named planes of floats. */
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
    for (uint32_t p = 0; p < like->plane_count && done; p++)
        done = image_add_plane(image, like->planes[p].name, like->planes[p].half);
    return done;
}

void image_finish(struct image *image)
{
    for (uint32_t i = 0; i < image->plane_count; i++)
        free(image->planes[i].texels);
    free(image->planes);
    *image = (struct image){ 0 };
}

float *image_add_plane(struct image *image, const char *name, bool half)
{
    const size_t count = image->plane_count;
    struct image_plane *planes;
    float *texels;

    assert(image->width > 0 && image->height > 0);
    assert(strlen(name) < IMAGE_NAME_SIZE && !image_find(image, name));
    if (image->width > SIZE_MAX / sizeof(float) / image->height)
        return NULL;
    planes = realloc(image->planes, (count + 1) * sizeof(*planes));
    if (!planes)
        return NULL;
    image->planes = planes;
    texels = calloc((size_t)image->width * image->height, sizeof(float));
    if (!texels)
        return NULL;
    planes[count] = (struct image_plane){ .half = half, .texels = texels };
    strncpy(planes[count].name, name, IMAGE_NAME_SIZE - 1);
    image->plane_count++;
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
