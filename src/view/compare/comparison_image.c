/* comparison_image.c: encodes and uploads a fixed comparison image. */
#include "src/view/compare/comparison_image.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/tech/output/tonemap.h"

void comparison_image_leave_device(struct comparison_image *s, struct gpu *gpu)
{
    gpu_image_destroy(gpu, &s->image);
    gpu_image_destroy(gpu, &s->previous);
    s->is_current = false;
}

static uint8_t to_byte(float x)
{
    return (uint8_t)lrintf(glm_clamp(x, 0.0f, 1.0f) * 255.0f);
}

static uint8_t *encode(const struct comparison_image *s)
{
    static const char *const names[] = { "R", "G", "B" };
    const size_t size = (size_t)s->linear.width * s->linear.height;
    uint8_t *rgba = malloc(size * 4);
    const struct tonemap_params encode_only = { 1.0f, TONEMAP_CLIP };
    const struct tonemap_params params = s->is_tone_mapped ? encode_only : s->tonemap;
    const float *planes[3];
    for (size_t c = 0; c < 3; c++)
        planes[c] = image_find(&s->linear, names[c]);
    for (size_t i = 0; i < size && rgba; i++) {
        vec3s linear = { { 0 } };
        for (size_t c = 0; c < 3; c++)
            linear.raw[c] = planes[c] ? planes[c][i] : 0.0f;
        const vec3s shown = tonemap_encode(linear, params);
        for (size_t c = 0; c < 3; c++)
            rgba[i * 4 + c] = to_byte(shown.raw[c]);
        rgba[i * 4 + 3] = 255;
    }
    return rgba;
}

enum status comparison_image_upload(struct comparison_image *s, struct gpu *gpu,
                                    const uint8_t *rgba, VkExtent2D size)
{
    const struct gpu_image_params params = {
        .name = "comparison_image",
        .format = VK_FORMAT_R8G8B8A8_UNORM,
        .width = size.width,
        .height = size.height,
        .texels = rgba,
        .texels_size = (size_t)size.width * size.height * 4,
    };
    if (s->is_current)
        return STATUS_OK;
    gpu_image_destroy(gpu, &s->previous);
    s->previous = s->image;
    s->image = (struct gpu_image){ 0 };
    const enum status status = gpu_image_create(gpu, &s->image, &params);
    s->is_current = status == STATUS_OK;
    return status;
}

enum status comparison_image_show(struct comparison_image *s, struct gpu *gpu,
                                  const struct tonemap_params *tonemap)
{
    if (s->is_current && (s->is_tone_mapped || tonemap_params_equal(&s->tonemap, tonemap)))
        return STATUS_OK;
    s->tonemap = *tonemap;
    uint8_t *rgba = encode(s);
    if (!rgba)
        return log_out_of_memory(NULL);
    s->is_current = false;
    const enum status status =
        comparison_image_upload(s, gpu, rgba, (VkExtent2D){ s->linear.width, s->linear.height });
    free(rgba);
    return status;
}
