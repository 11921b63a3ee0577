/* renderer_progressive.c: accumulates full-size samples and tone-maps their mean. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "graph/rg_firn.h"
#include "src/base/log.h"
#include "src/file/half_float.h"
#include "src/render/make_frame_request.h"
#include "src/render/renderer_internal.h"
#include "src/render/sample_accumulation.h"
#include "src/render/weighted_mean.h"

enum status renderer_set_view(struct renderer *r, VkExtent2D view)
{
    struct frame_request request = renderer_image_request(&r->params);
    if (r->width == view.width && r->height == view.height)
        return STATUS_OK;
    if (renderer_abandon(r) != STATUS_OK)
        return STATUS_FAILED;
    struct rg_exec_import *imports = renderer_imports(r, r->image.frame);
    if (!imports)
        return log_out_of_memory(NULL);
    request.view = view;
    const enum status status = compiled_frame_change_view(&r->image, &r->params, request, imports);
    free(imports);
    if (status == STATUS_OK) {
        r->width = view.width;
        r->height = view.height;
    }
    return status;
}

/* Allocates the sums at the image size and fills them with 0. */
static bool clear_sums(struct renderer *r)
{
    image_finish(&r->sums);
    image_finish(&r->display_sums);
    image_finish(&r->shown);
    image_init(&r->sums, r->params.width, r->params.height);
    image_init(&r->display_sums, r->params.width, r->params.height);
    return accumulate_add_planes(&r->sums, &frame_beauty) &&
           (!renderer_is_weighted(&r->params) || weighted_mean_add_planes(&r->display_sums));
}

/* Begins a sample of the full size. */
static enum status begin_sample(struct renderer *r, const struct renderer_shot *shot,
                                uint32_t sample)
{
    const VkExtent2D whole = { r->params.width, r->params.height };
    if (sample == 0 && !clear_sums(r))
        return log_out_of_memory(NULL);
    enum status status = renderer_set_view(r, whole);
    if (status == STATUS_OK)
        status = renderer_capture_cube(r, shot);
    if (status == STATUS_OK && !sample)
        status = gpu_status(rg_exec_abandon(r->image.exec)); /* the view may be another one */
    r->skips_readback = false;
    if (status == STATUS_OK)
        status = renderer_begin_frame(r, &r->image, shot, sample, &r->partial, &r->last_slot);
    r->is_partial = status == STATUS_OK;
    return status;
}

/* Draws the next part of a sample. After the last one, r->is_partial is false. */
static enum status draw_part(struct renderer *r, const struct renderer_shot *shot, uint32_t sample,
                             double seconds)
{
    enum status status = r->is_partial ? STATUS_OK : begin_sample(r, shot, sample);
    if (status != STATUS_OK)
        return status;
    const VkResult result = rg_exec_submit_part(r->image.exec, &r->partial.graph, seconds);
    if (result == VK_NOT_READY)
        return STATUS_OK;
    r->is_partial = false;
    status = result == VK_SUCCESS ? renderer_wait(r) : gpu_status(result);
    if (status != STATUS_OK)
        return status;
    renderer_mark_drawn(r, &r->partial);
    r->sample = SAMPLE_DRAWN;
    return STATUS_OK;
}

enum status renderer_refine(struct renderer *r, const struct renderer_shot *shot, uint32_t sample,
                            double seconds, bool *is_done)
{
    const bool is_added = r->sample == SAMPLE_ADDED && sample;
    enum status status = STATUS_OK;
    r->sample = r->sample == SAMPLE_ADDED ? SAMPLE_NONE : r->sample;
    *is_done = is_added;
    if (is_added)
        return STATUS_OK;
    if (r->sample == SAMPLE_NONE) {
        status = draw_part(r, shot, sample, seconds);
        if (status != STATUS_OK || r->is_partial || seconds < HUGE_VAL)
            return status;
    }
    do
        renderer_add_sample(r);
    while (r->sample != SAMPLE_NONE && seconds >= HUGE_VAL);
    *is_done = r->sample == SAMPLE_NONE;
    return STATUS_OK;
}

void renderer_display_pixel(const struct renderer *r, size_t i, float rgba[static 4])
{
    for (size_t p = 0; p < 4; p++)
        rgba[p] = r->shown.planes ? r->shown.planes[p].texels[i] : 0.0f;
}

static bool is_shown_weighted(const struct renderer *r, uint32_t sample_count)
{
    return r->display_sums.planes && sample_count > 1;
}

/* Computes the unfiltered mean of the samples for display. Keeps the sums. */
static enum status find_shown(struct renderer *r, uint32_t sample_count)
{
    const bool is_weighted = is_shown_weighted(r, sample_count);
    const float scale = weighted_mean_scale(r->params.settings);
    const struct image *like = r->display_sums.planes ? &r->display_sums : &r->sums;
    const bool exists = r->shown.planes || image_init_like(&r->shown, like, like->height);
    if (!exists || !r->shown.planes) {
        image_finish(&r->shown); /* the next call tries again */
        return log_out_of_memory(NULL);
    }
    for (size_t i = 0; i < (size_t)r->sums.width * r->sums.height; i++) {
        if (is_weighted)
            weighted_mean_pixel(&r->display_sums, i, sample_count, scale, &r->shown);
        for (size_t p = 0; p < 4 && !is_weighted; p++)
            r->shown.planes[p].texels[i] = r->sums.planes[p].texels[i] / (float)sample_count;
    }
    return STATUS_OK;
}

/* Tone-maps the filtered mean on the device. */
static enum status submit_shown(struct renderer *r)
{
    uint32_t slot;
    const struct rg_frame frame = { .settings = r->params.settings };
    const enum status status = gpu_status(rg_exec_begin(r->resolve.exec, &slot));
    if (status != STATUS_OK)
        return status;
    uint16_t *texels = rg_exec_mapped(r->resolve.exec, &frame_samples, slot);
    for (size_t i = 0; i < (size_t)r->sums.width * r->sums.height; i++) {
        for (size_t p = 0; p < 4; p++)
            texels[i * 4 + p] = half_from_float(r->shown.planes[p].texels[i]);
    }
    return gpu_status(rg_exec_submit(r->resolve.exec, &frame));
}

enum status renderer_resolve(struct renderer *r, uint32_t sample_count, uint32_t step)
{
    const struct settings *settings = r->params.settings;
    const float scale = weighted_mean_scale(settings);
    if (step == 0)
        return find_shown(r, sample_count);
    if (step == RENDERER_RESOLVE_STEPS - 1)
        return submit_shown(r);
    if (!is_shown_weighted(r, sample_count) || !weighted_mean_is_filtered(settings))
        return STATUS_OK;
    return (step == 1 ? weighted_mean_reconstruct : weighted_mean_denoise)(&r->shown, scale)
               ? STATUS_OK
               : log_out_of_memory(NULL);
}

const struct image *renderer_sums(const struct renderer *r)
{
    return &r->sums;
}

uint32_t renderer_sum_count(const struct renderer *r)
{
    return r->sum_count;
}

VkImage renderer_mean(const struct renderer *r)
{
    return rg_exec_image(r->resolve.exec, &frame_display);
}
