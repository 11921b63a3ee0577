/* renderer_smooth.c: accumulates the lighting of surroundings separately and denoises it. */
#include "src/base/log.h"
#include "src/render/accumulate.h"
#include "src/render/adaptive.h"
#include "src/render/renderer_internal.h"
#include "src/render/request.h"
#include "src/render/smooth.h"
#include "src/tech/frame.h"

bool renderer_smooth_begin(struct renderer *r)
{
    image_finish(&r->ground);
    if (!renderer_smooths(&r->params))
        return true;
    image_init(&r->ground, r->tile.width, r->tile.height);
    for (size_t i = 0; i < FRAME_SMOOTH_COUNT; i++) {
        if (!accumulate_add_planes(&r->ground, &frame_smooth_layers[i]))
            return false;
    }
    float *samples = image_add_plane(&r->ground, "samples", false);
    for (size_t i = 0; samples && i < (size_t)r->tile.width * r->tile.height; i++)
        samples[i] = (float)r->params.samples;
    return samples;
}

void renderer_smooth_fetch(struct renderer *r, const struct tile *tile, uint32_t sample,
                           uint32_t slot)
{
    for (size_t i = 0; i < FRAME_SMOOTH_COUNT && r->ground.planes; i++) {
        const struct frame_layer *layer = &frame_smooth_layers[i];
        const void *texels = renderer_read_back(&r->picture, layer->image, slot);
        if (texels)
            accumulate_sample(&r->ground, tile, layer, texels, sample);
    }
}

void renderer_smooth_even(struct renderer *r, const struct adaptive *adaptive)
{
    float *samples = image_find(&r->ground, "samples");
    if (!samples)
        return;
    for (size_t i = 0; i < FRAME_SMOOTH_COUNT; i++)
        adaptive_even(adaptive, &r->ground, &frame_smooth_layers[i]);
    for (size_t i = 0; i < (size_t)adaptive->width * adaptive->height; i++)
        samples[i] = (float)adaptive_count(adaptive, (uint32_t)(i % adaptive->width),
                                           (uint32_t)(i / adaptive->width));
}

enum status renderer_smooth_end(struct renderer *r, struct image *image)
{
    if (!r->ground.planes)
        return STATUS_OK;
    for (size_t i = 0; i < FRAME_SMOOTH_COUNT; i++)
        accumulate_mean(&r->ground, &frame_smooth_layers[i], r->params.samples);
    const bool is_done = smooth_light(image, &r->ground);
    image_finish(&r->ground);
    return is_done ? STATUS_OK : log_out_of_memory(NULL);
}
