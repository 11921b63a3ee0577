/* renderer_denoise.c: accumulates the lighting of surroundings separately and denoises it. */
#include "src/base/log.h"
#include "src/render/adaptive_sampling.h"
#include "src/render/denoise.h"
#include "src/render/make_frame_request.h"
#include "src/render/renderer_internal.h"
#include "src/render/sample_accumulation.h"
#include "src/tech/frame_resources.h"

bool renderer_denoise_begin(struct renderer *r)
{
    image_finish(&r->lighting);
    if (!renderer_denoises(&r->params))
        return true;
    image_init(&r->lighting, r->tile.width, r->tile.height);
    for (size_t i = 0; i < FRAME_DENOISE_COUNT; i++) {
        if (!accumulate_add_planes(&r->lighting, &frame_denoise_layers[i]))
            return false;
    }
    float *samples = image_add_plane(&r->lighting, "samples", false);
    for (size_t i = 0; samples && i < (size_t)r->tile.width * r->tile.height; i++)
        samples[i] = (float)r->params.samples;
    return samples;
}

void renderer_denoise_accumulate(struct renderer *r, const struct tile *tile, uint32_t sample,
                                 uint32_t slot)
{
    for (size_t i = 0; i < FRAME_DENOISE_COUNT && r->lighting.planes; i++) {
        const struct frame_layer *layer = &frame_denoise_layers[i];
        const void *texels = renderer_read_back(&r->image, layer->image, slot);
        if (texels)
            accumulate_sample(&r->lighting, tile, layer, texels, sample);
    }
}

void renderer_denoise_rescale(struct renderer *r, const struct adaptive *adaptive)
{
    float *samples = image_find(&r->lighting, "samples");
    if (!samples)
        return;
    for (size_t i = 0; i < FRAME_DENOISE_COUNT; i++)
        adaptive_rescale(adaptive, &r->lighting, &frame_denoise_layers[i]);
    for (size_t i = 0; i < (size_t)adaptive->width * adaptive->height; i++)
        samples[i] = (float)adaptive_count(adaptive, (uint32_t)(i % adaptive->width),
                                           (uint32_t)(i / adaptive->width));
}

enum status renderer_denoise_end(struct renderer *r, struct render_result *result)
{
    if (!r->lighting.planes)
        return STATUS_OK;
    for (size_t i = 0; i < FRAME_DENOISE_COUNT; i++)
        accumulate_mean(&r->lighting, &frame_denoise_layers[i], r->params.samples);
    const bool is_done = denoise_light(&result->image, &result->display, &r->lighting);
    image_finish(&r->lighting);
    return is_done ? STATUS_OK : log_out_of_memory(NULL);
}
