/* renderer_adaptive_sampling.c: draws an image with adaptive sampling, rectangle by rectangle. */
#include "src/base/log.h"
#include "src/render/adaptive_sampling.h"
#include "src/render/renderer_internal.h"
#include "src/render/weighted_mean.h"
#include "src/tech/techniques.h"

/* Draws one sample of every rectangle of the current round. */
static enum status draw_tiles(struct renderer *r, const struct renderer_shot *shot,
                              struct render_result *result, struct adaptive *adaptive,
                              uint32_t sample)
{
    enum status status = STATUS_OK;
    for (uint32_t p = 0; p < adaptive->rectangle_count && status == STATUS_OK; p++) {
        r->tile = adaptive->rectangles[p];
        status = renderer_run(r, &r->image, shot, sample, &r->last_slot);
        if (status == STATUS_OK)
            status = renderer_read_sample(r, result, &r->tile, sample, r->last_slot);
        if (status == STATUS_OK)
            adaptive_add(adaptive, &r->tile,
                         renderer_read_back(&r->image, frame_beauty.image, r->last_slot), sample);
    }
    return status;
}

enum status renderer_draw_adaptive(struct renderer *r, const struct renderer_shot *shot,
                                   struct render_result *result, renderer_progress_fn *progress,
                                   void *user)
{
    const struct tile whole = r->tile;
    struct adaptive adaptive;
    uint32_t sample = 0;
    if (!adaptive_init(&adaptive, whole.width, whole.height))
        return log_out_of_memory(NULL);
    enum status status = renderer_capture_cube(r, shot);
    r->skips_readback = false;
    while (status == STATUS_OK && (sample < adaptive.end || adaptive_next_round(&adaptive))) {
        status = draw_tiles(r, shot, result, &adaptive, sample++);
        if (status == STATUS_OK && progress && !progress(user, sample, ADAPTIVE_SAMPLES))
            status = STATUS_FAILED;
    }
    r->tile = whole;
    adaptive_rescale(&adaptive, &result->image, &frame_beauty);
    for (uint32_t i = 0; techniques_layer(i); i++) {
        if (r->params.layers & UINT64_C(1) << i)
            adaptive_rescale(&adaptive, &result->image, techniques_layer(i));
    }
    adaptive_rescale(&adaptive, &result->display, &frame_beauty);
    adaptive_rescale(&adaptive, &result->display, &weighted_mean_extra);
    renderer_denoise_rescale(r, &adaptive);
    result->samples = adaptive_mean(&adaptive);
    adaptive_finish(&adaptive);
    return status;
}
