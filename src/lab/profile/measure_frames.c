/* measure_frames.c: renders frames repeatedly and records their GPU and CPU times in profiles. */
#include "src/lab/profile/measure_frames.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/base/machine.h"
#include "src/base/parallel.h"
#include "src/gpu/gpu_renderdoc_capture.h"

struct measure {
    const struct profile_request *request;
    struct profile *profile;
    struct renderer *renderer;
    const struct rg_plan *plan;
};

static double ms(uint64_t ns)
{
    return (double)ns * 1e-6;
}

static uint64_t target_size(const struct rg_plan *plan, const struct rg_plan_pass *pass,
                            const struct rg_plan_target *target)
{
    if (target->image == RG_NONE)
        return 0;
    const struct rg_plan_image *image = &plan->images[target->image];
    return (uint64_t)pass->extent.width * pass->extent.height * image->samples *
           rg_format_info(image->image->format)->size;
}

/* Names a pass's row. Passes of equal name (one per object or cube face) become repetitions. */
static void name_pass(const struct measure *m, uint32_t index, struct profile_row *row)
{
    const struct rg_plan *plan = m->plan;
    const char *name = renderer_pass_name(m->renderer, plan->passes[index].pass);
    snprintf(row->name, sizeof(row->name), "%s", name);
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        const bool is_same = !strcmp(renderer_pass_name(m->renderer, plan->passes[p].pass), name);
        row->repetition += is_same && p < index;
        row->repetition_count += is_same;
    }
}

static void describe_pass(const struct measure *m, uint32_t index, struct profile_row *row)
{
    const struct rg_plan *plan = m->plan;

    static const enum profile_kind kinds[] = {
        [RG_RASTER] = PROFILE_RASTER,
        [RG_COMPUTE] = PROFILE_COMPUTE,
        [RG_TRANSFER] = PROFILE_TRANSFER,
    };
    const struct rg_plan_pass *pass = &plan->passes[index];
    name_pass(m, index, row);
    snprintf(row->technique, sizeof(row->technique), "%s", pass->technique->name);
    row->kind = kinds[pass->pass->kind];
    row->target_bytes = target_size(plan, pass, &pass->depth);
    for (uint32_t c = 0; c < pass->color_count; c++)
        row->target_bytes += target_size(plan, pass, &pass->color[c]);
    if (row->target_bytes) {
        row->width = pass->extent.width;
        row->height = pass->extent.height;
    }
}

static void add_resident(struct profile *p, const char *name, struct profile_resource resident)
{
    if (resident.block == RG_NONE)
        return;
    snprintf(resident.name, sizeof(resident.name), "%s", name);
    if (resident.last_pass >= p->pass_count)
        resident.last_pass = p->pass_count - 1;
    p->residents[p->resident_count++] = resident;
}

static enum status describe_memory(struct profile *p, const struct rg_plan *plan)
{
    p->memory_used = plan->memory_used;
    p->memory_without_aliasing = plan->memory_without_aliasing;
    p->memory_bound = plan->memory_bound;
    p->memory_persistent = plan->memory_persistent;
    p->residents =
        calloc((size_t)plan->image_count + plan->buffer_count + 1, sizeof(*p->residents));
    if (!p->residents)
        return log_out_of_memory(NULL);
    for (uint32_t i = 0; i < plan->image_count; i++) {
        const struct rg_plan_image *image = &plan->images[i];
        add_resident(p, image->image->name,
                     (struct profile_resource){
                         .first_pass = image->first,
                         .last_pass = image->last,
                         .block = image->block,
                         .offset = image->offset,
                         .size = image->size,
                     });
    }
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        const struct rg_plan_buffer *buffer = &plan->buffers[i];
        add_resident(p, buffer->buffer->name,
                     (struct profile_resource){
                         .first_pass = buffer->first,
                         .last_pass = buffer->last,
                         .block = buffer->block,
                         .offset = buffer->offset,
                         .size = buffer->memory_size,
                     });
    }
    return STATUS_OK;
}

static void describe_host(char *text, size_t size)
{
    char model[192];
    machine_processor(model, sizeof(model));
    const uint32_t count = machine_core_count();
    snprintf(text, size, "%s, %u thread%s", model, count, count == 1 ? "" : "s");
}

static void describe(struct profile *p, const struct profile_request *request)
{
    const struct gpu *gpu = request->renderer.gpu;
    struct gpu_device device;
    gpu_describe(gpu, &device);
    snprintf(p->device, sizeof(p->device), "%s", device.name);
    snprintf(p->driver, sizeof(p->driver), "%s, Vulkan %s", device.kind, device.version);
    describe_host(p->host, sizeof(p->host));
    snprintf(p->refraction, sizeof(p->refraction), "%s",
             request->renderer.refraction->refraction.name);
    p->width = request->renderer.width;
    p->height = request->renderer.height;
    snprintf(p->clock, sizeof(p->clock), "%s",
             request->clock == RG_CLOCK_SUBMITS ? "submits" : "timestamps");
    p->has_statistics = gpu->has_statistics;
    p->warmup = request->warmup;
    p->run_count = request->run_count;
    p->time = request->time;
    p->time_step = request->time_step;
}

static enum status draw(struct measure *m, double time, const struct rg_measure *what,
                        double *frame_ms)
{
    const struct renderer_shot shot = { .camera = m->request->camera, .time = (float)time };
    renderer_measure(m->renderer, what);
    const double start = clock_ms();
    enum status status = renderer_draw(m->renderer, &shot);
    if (status == STATUS_OK)
        status = renderer_wait(m->renderer);
    *frame_ms = clock_ms() - start;
    return status;
}

static void keep_run(struct profile *p, const struct rg_times *times, uint32_t run)
{
    double left = p->frame[run];
    for (uint32_t i = 0; i < p->pass_count; i++) {
        const struct rg_pass_time *time = &times->passes[i];
        p->rows[i].ms[run] = ms(time->end - time->begin);
        p->rows[i].begin_ms[run] = ms(time->begin);
        p->rows[i].record_ms[run] = ms(time->record);
        left -= p->rows[i].ms[run];
    }
    p->rows[p->pass_count].ms[run] = ms(times->record);
    p->rows[p->pass_count + 1].ms[run] = ms(times->submit);
    p->rows[p->pass_count + 2].ms[run] = left - ms(times->record) - ms(times->submit);
    p->wait[run] = ms(times->wait);
}

static void keep_counts(struct profile *p, const struct rg_times *times)
{
    for (uint32_t i = 0; i < p->pass_count; i++) {
        p->rows[i].vertices = times->passes[i].vertices;
        p->rows[i].triangles = times->passes[i].triangles;
        p->rows[i].fragments = times->passes[i].fragments;
        p->rows[i].covered = times->passes[i].samples;
        p->rows[i].invocations = times->passes[i].invocations;
    }
}

/* Renders a measured and an unmeasured frame, in alternating order to balance caching. */
static enum status run_once(struct measure *m, uint32_t index)
{
    const struct rg_measure nothing = { RG_CLOCK_NONE, false };
    const struct rg_measure passes = { m->request->clock, false };
    const uint32_t run = index > m->request->warmup ? index - m->request->warmup : 0;
    const double time = m->request->time + run * m->request->time_step;
    double frame_ms[2];
    struct rg_times times = { 0 };
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < 2 && status == STATUS_OK; i++) {
        const bool is_measured = (index + i) % 2;
        status = draw(m, time, is_measured ? &passes : &nothing, &frame_ms[is_measured]);
        if (status == STATUS_OK && is_measured && index >= m->request->warmup) {
            times = renderer_times(m->renderer);
            m->profile->frame[run] = frame_ms[1];
            keep_run(m->profile, &times, run);
        }
    }
    if (status == STATUS_OK && index >= m->request->warmup)
        m->profile->plain[run] = frame_ms[0];
    return status;
}

/* Captures one unmeasured frame with RenderDoc. */
static enum status capture(struct measure *m)
{
    const struct rg_measure nothing = { RG_CLOCK_NONE, false };
    const struct gpu *gpu = m->request->renderer.gpu;
    double frame_ms;
    gpu_capture_begin(gpu);
    enum status status = draw(m, m->request->time, &nothing, &frame_ms);
    const enum status ended = gpu_capture_end(gpu, m->request->capture, MEASURE_PATH_SIZE);
    return status == STATUS_OK ? ended : status;
}

/* Renders the frames before the runs: first frame, pipeline statistics and RenderDoc capture. */
static enum status begin(struct measure *m)
{
    const struct rg_measure nothing = { RG_CLOCK_NONE, false };
    const struct rg_measure counts = { RG_CLOCK_NONE, true };
    double frame_ms;
    enum status status = draw(m, m->request->time, &nothing, &m->profile->first_frame);
    if (status == STATUS_OK && m->profile->has_statistics) {
        status = draw(m, m->request->time, &counts, &frame_ms);
        const struct rg_times times = renderer_times(m->renderer);
        if (status == STATUS_OK)
            keep_counts(m->profile, &times);
    }
    return status == STATUS_OK && m->request->capture ? capture(m) : status;
}

static enum status open_renderer(struct measure *m)
{
    struct profile *p = m->profile;
    struct renderer_params params = m->request->renderer;
    params.samples = 1;
    params.layers = 0;
    params.linear = false;
    params.display = false;
    params.keep = true;
    params.measured = true;
    enum status status = renderer_create(&m->renderer, &params);
    if (status != STATUS_OK)
        return status;
    const struct renderer_costs costs = renderer_costs(m->renderer);
    p->bvh_ms = costs.bvh;
    p->bvh_triangles = costs.bvh_triangles;
    p->bvh_size = costs.bvh_size;
    p->rays = costs.rays;
    p->rays_size = costs.rays_size;
    p->upload = costs.upload;
    p->compile = costs.compile;
    p->realise = costs.realise;
    m->plan = renderer_frame(m->renderer);
    p->pass_count = m->plan->pass_count;
    status = profile_make_rows(p);
    for (uint32_t i = 0; i < p->pass_count && status == STATUS_OK; i++)
        describe_pass(m, i, &p->rows[i]);
    return status == STATUS_OK ? describe_memory(p, m->plan) : status;
}

enum status profile_measure(const struct profile_request *request, struct profile *profile,
                            profile_progress_fn *progress, void *user)
{
    struct measure m = { .request = request, .profile = profile };
    const uint32_t run_count = request->warmup + request->run_count;
    *profile = (struct profile){ 0 };
    describe(profile, request);
    enum status status = open_renderer(&m);
    if (status == STATUS_OK)
        status = begin(&m);
    for (uint32_t i = 0; i < run_count && status == STATUS_OK; i++) {
        status = run_once(&m, i);
        if (status == STATUS_OK)
            progress(user, i + 1, run_count);
    }
    renderer_destroy(m.renderer);
    if (status != STATUS_OK)
        profile_finish(profile);
    return status;
}
