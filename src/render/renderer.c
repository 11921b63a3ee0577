/* renderer.c: the renderer's plans and executors, and the draw loop over samples and tiles. */
#include "src/render/renderer.h"
#include <assert.h>
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/file/half_float.h"
#include "src/render/adaptive_sampling.h"
#include "src/render/make_frame_request.h"
#include "src/render/renderer_internal.h"
#include "src/render/sample_accumulation.h"
#include "src/render/weighted_mean.h"

/* ---- plans ---- */

bool renderer_uses_bvh(const struct renderer_params *params)
{
    return params->refraction && params->refraction->refraction.traces_bvh;
}

bool renderer_wants_capture(const struct renderer_params *params)
{
    return !frame_draws_cube(params->settings, params->scene) &&
           !params->scene->background.cube.texels;
}

bool renderer_wants_resolve(const struct renderer_params *params)
{
    return params->refines ||
           (params->display && (params->samples > 1 || renderer_denoises(params)));
}

bool renderer_is_weighted(const struct renderer_params *params)
{
    const bool is_mean = params->samples > 1 && (params->display || params->resolved);
    return (is_mean || params->refines) && weighted_mean_scale(params->settings) > 0.0f;
}

static VkImage find_import(const struct renderer *r, const struct rg_image *image)
{
    if (image == &frame_env_cube && r->capture.exec)
        return rg_exec_image(r->capture.exec, image);
    return uploaded_scene_image(r->scene, image);
}

struct rg_exec_import *renderer_imports(const struct renderer *r, const struct frame_plan *plan)
{
    struct rg_exec_import *imports = calloc(plan->import_count + 1, sizeof(*imports));
    for (size_t i = 0; i < plan->import_count && imports; i++) {
        if (plan->imports[i].access == RG_TRACE && r->bvh.rays)
            imports[i] = (struct rg_exec_import){ .buffer = r->bvh.rays->tlas_memory.buffer,
                                                  .acceleration = r->bvh.rays->tlas };
        else if (plan->imports[i].buffer)
            imports[i].buffer = uploaded_scene_buffer(&r->bvh, plan->imports[i].buffer);
        else
            imports[i].image = find_import(r, plan->imports[i].image);
    }
    return imports;
}

static enum status realise(struct renderer *r, struct compiled_frame *compiled_frame)
{
    struct rg_exec_import *imports = renderer_imports(r, compiled_frame->frame);
    const enum status status = imports ? compiled_frame_realise(compiled_frame, &r->params, imports)
                                       : log_out_of_memory(NULL);
    free(imports);
    return status;
}

enum status renderer_compile(struct renderer *r, struct compiled_frame *compiled_frame,
                             struct frame_request request)
{
    enum status status = compiled_frame_compile(compiled_frame, &r->params, request);
    if (status == STATUS_OK)
        status = realise(r, compiled_frame);
    return status;
}

enum status renderer_upload_bvh(struct renderer *r)
{
    const struct renderer_params *p = &r->params;
    enum status status = STATUS_OK;
    if (!r->bvh.imports)
        status = uploaded_scene_init_bvh(&r->bvh, p->gpu, p->scene);
    if (status == STATUS_OK && renderer_image_request(p).config.uses_queries)
        status = uploaded_scene_build_acceleration(&r->bvh, p->gpu, p->scene);
    return status;
}

static enum status upload(struct renderer *r)
{
    enum status status = STATUS_OK;
    r->scene = r->params.uploaded ? r->params.uploaded : &r->own;
    if (!r->params.uploaded)
        status = uploaded_scene_init(&r->own, r->params.gpu, r->params.scene);
    if (status == STATUS_OK && renderer_uses_bvh(&r->params))
        status = renderer_upload_bvh(r);
    r->meshes = calloc(techniques_count, sizeof(*r->meshes));
    if (status == STATUS_OK && !r->meshes) {
        status = log_out_of_memory(NULL);
    }
    for (size_t i = 0; i < techniques_count && status == STATUS_OK; i++)
        r->meshes[i] = uploaded_scene_mesh(&r->scene->meshes[i], false);
    return status;
}

void renderer_set_params(struct renderer *r, const struct renderer_params *params)
{
    r->params = *params;
    r->params.samples = params->samples ? params->samples : 1;
    if (params->is_adaptive)
        r->params.samples = ADAPTIVE_SAMPLES;
    r->params.columns = params->columns ? params->columns : 1;
    r->params.rows = params->rows ? params->rows : 1;
    if (!params->face_size)
        r->params.face_size = frame_face_size(params->settings, params->height);
    r->width = params->width;
    r->height = params->height;
    if (renderer_is_interleaved(params)) {
        assert(r->width % params->columns == 0 && r->height % params->rows == 0);
        r->params.width = r->width / params->columns;
        r->params.height = r->height / params->rows;
    }
    r->tiling = renderer_tiling(&r->params);
    r->tile = tile_at(&r->tiling, 0);
}

enum status renderer_build_bvh(struct renderer *r)
{
    if (!r->params.scene->bvh) {
        r->own_scene = *r->params.scene;
        r->own_scene.bvh = &r->own_bvh;
        r->params.scene = &r->own_scene;
    }
    const enum status status = scene_build_bvh(r->params.scene, !r->params.gpu->no_cache);
    struct bvh *bvh = r->params.scene->bvh;
    const uint32_t limit = r->params.gpu->properties.limits.maxTexelBufferElements;
    if (status == STATUS_OK && !bvh->is_stored)
        bvh->is_stored = bvh_words_max(bvh) > limit;
    r->costs.bvh = bvh->ms;
    r->costs.bvh_triangles = bvh->triangle_count;
    r->costs.bvh_size = bvh_size(bvh);
    return status;
}

enum status renderer_create(struct renderer **renderer, const struct renderer_params *params)
{
    struct renderer *r = calloc(1, sizeof(*r));
    *renderer = NULL;
    if (!r)
        return log_out_of_memory(NULL);
    renderer_set_params(r, params);
    enum status status = gpu_check_size(params->gpu, r->params.width, r->params.height);
    if (status == STATUS_OK)
        status = uploaded_scene_check(params->gpu, params->scene);
    if (status == STATUS_OK && renderer_uses_bvh(params))
        status = renderer_build_bvh(r);
    const double start = clock_ms();
    if (status == STATUS_OK)
        status = compiled_frame_compile(&r->image, &r->params, renderer_image_request(&r->params));
    r->costs.compile = clock_ms() - start;
    const double compiled = clock_ms();
    if (status == STATUS_OK)
        status = frame_objects_init(&r->objects, &r->image.frame->list, params->scene);
    if (status == STATUS_OK)
        status = upload(r);
    r->costs.upload = clock_ms() - compiled;
    r->costs.rays = r->bvh.rays ? r->bvh.rays->ms : 0.0;
    r->costs.rays_size = r->bvh.rays ? r->bvh.rays->size : 0;
    if (status == STATUS_OK && renderer_wants_capture(&r->params))
        status = renderer_compile(r, &r->capture, renderer_capture_request(&r->params));
    if (status == STATUS_OK && renderer_wants_resolve(&r->params))
        status = renderer_compile(r, &r->resolve, renderer_resolve_request(&r->params));
    const double begin = clock_ms();
    if (status == STATUS_OK)
        status = realise(r, &r->image);
    r->costs.realise = clock_ms() - begin;
    if (status == STATUS_OK)
        *renderer = r;
    else
        renderer_destroy(r);
    return status;
}

void renderer_destroy(struct renderer *renderer)
{
    if (!renderer)
        return;
    compiled_frame_destroy(&renderer->resolve);
    compiled_frame_destroy(&renderer->image);
    compiled_frame_destroy(&renderer->capture);
    frame_objects_finish(&renderer->objects);
    uploaded_scene_finish(&renderer->own, renderer->params.gpu);
    uploaded_scene_finish(&renderer->bvh, renderer->params.gpu);
    bvh_finish(&renderer->own_bvh);
    image_finish(&renderer->sums);
    image_finish(&renderer->display_sums);
    image_finish(&renderer->shown);
    image_finish(&renderer->lighting);
    free(renderer->meshes);
    free(renderer);
}

/* ---- an image ---- */

enum status renderer_draw(struct renderer *r, const struct renderer_shot *shot)
{
    enum status status = renderer_capture_cube(r, shot);
    r->skips_readback = true;
    if (status == STATUS_OK)
        status = renderer_run(r, &r->image, shot, 0, &r->last_slot);
    return status;
}

enum status renderer_wait(struct renderer *r)
{
    return gpu_status(rg_exec_wait(r->image.exec, r->last_slot));
}

VkImage renderer_display_image(const struct renderer *r)
{
    return rg_exec_image(r->image.exec, &frame_display);
}

struct renderer_costs renderer_costs(const struct renderer *r)
{
    return r->costs;
}

void renderer_measure(struct renderer *r, const struct rg_measure *measure)
{
    rg_exec_measure(r->image.exec, measure);
}

struct rg_times renderer_times(const struct renderer *r)
{
    return rg_exec_times(r->image.exec);
}

const struct rg_plan *renderer_frame(const struct renderer *r)
{
    return r->image.frame->plan;
}

const char *renderer_pass_name(const struct renderer *r, const struct rg_pass *row)
{
    return frame_list_pass_name(&r->image.frame->list, row);
}

static enum status draw_samples(struct renderer *r, const struct renderer_shot *shot,
                                struct render_result *result, renderer_progress_fn *progress,
                                void *user)
{
    const struct tile pixels = { .width = result->image.width, .height = result->image.height };
    enum status status = renderer_capture_cube(r, shot);
    r->skips_readback = false;
    /* The device draws one sample while the host accumulates the previous one. */
    for (uint32_t i = 0; i <= r->params.samples && status == STATUS_OK; i++) {
        uint32_t slot_before = r->last_slot;
        if (i < r->params.samples)
            status = renderer_run(r, &r->image, shot, i, &r->last_slot);
        if (i == 0 || status != STATUS_OK)
            continue;
        status = renderer_read_sample(r, result, &pixels, i - 1, slot_before);
        if (status == STATUS_OK && progress && !progress(user, i, r->params.samples))
            status = STATUS_FAILED;
    }
    return status;
}

/* Copies a rectangle of 8-bit pixels. Rows are `from_width` and `to_width` pixels long. */
static void copy_pixels(const uint8_t *from, size_t from_width, uint8_t *to, size_t to_width,
                        const struct tile *size)
{
    for (size_t y = 0; y < size->height; y++)
        memcpy(to + y * to_width * 4, from + y * from_width * 4, (size_t)size->width * 4);
}

/* Uploads a rectangle of the mean of the samples as half floats (the format of frame_color), and
 * tone-maps it. */
static enum status resolve_tile(struct renderer *r, const struct image *image,
                                const struct tile *tile, uint8_t *rgba)
{
    const uint32_t width = r->resolve.frame->plan->view.width;
    const size_t first = (size_t)tile->y * image->width + tile->x;
    uint32_t slot;
    enum status status = gpu_status(rg_exec_begin(r->resolve.exec, &slot));
    uint16_t *texels =
        status == STATUS_OK ? rg_exec_mapped(r->resolve.exec, &frame_samples, slot) : NULL;
    for (size_t p = 0; p < 4 && texels; p++) {
        const float *plane = image_find(image, frame_beauty.planes[p]) + first;
        for (size_t y = 0; y < tile->height; y++) {
            for (size_t x = 0; x < tile->width; x++)
                texels[(y * width + x) * 4 + p] = half_from_float(plane[y * image->width + x]);
        }
    }
    const struct rg_frame frame = { .settings = r->params.settings };
    if (status == STATUS_OK)
        status = gpu_status(rg_exec_submit(r->resolve.exec, &frame));
    if (status == STATUS_OK)
        status = gpu_status(rg_exec_wait(r->resolve.exec, slot));
    if (status == STATUS_OK)
        copy_pixels(renderer_read_back(&r->resolve, &frame_display, slot), width, rgba + first * 4,
                    image->width, tile);
    return status;
}

/* Tone-maps an image tile by tile, since the view of the plan has the size of a tile. */
static enum status resolve_display(struct renderer *r, const struct image *image, uint8_t **rgba)
{
    const VkExtent2D size = r->resolve.frame->plan->view;
    enum status status = STATUS_OK;
    *rgba = malloc((size_t)image->width * image->height * 4);
    if (!*rgba)
        return log_out_of_memory(NULL);
    for (uint32_t y = 0; y < image->height; y += size.height) {
        const uint32_t height = image->height - y < size.height ? image->height - y : size.height;
        for (uint32_t x = 0; x < image->width && status == STATUS_OK; x += size.width) {
            const uint32_t width = image->width - x < size.width ? image->width - x : size.width;
            status = resolve_tile(r, image, &(struct tile){ x, y, width, height }, *rgba);
        }
    }
    return status;
}

static bool add_planes(struct renderer *r, struct render_result *result)
{
    const bool many = r->params.samples > 1 || renderer_denoises(&r->params);
    const bool is_weighted = renderer_is_weighted(&r->params);
    const bool has_mean = r->params.resolved || (r->params.display && many);
    struct image *image = &result->image;
    render_result_clear(result, r->tile.width, r->tile.height);
    if (is_weighted && !weighted_mean_add_planes(&result->display))
        return false;
    if (r->params.linear || (has_mean && !is_weighted)) {
        if (!accumulate_add_planes(image, &frame_beauty))
            return false;
    }
    for (uint32_t i = 0; techniques_layer(i); i++) {
        if (renderer_wants_layer(r, i) && !accumulate_add_planes(image, techniques_layer(i)))
            return false;
    }
    result->samples = (float)r->params.samples;
    return renderer_denoise_begin(r);
}

static enum status divide_sums(struct renderer *r, struct render_result *result)
{
    struct image *image = &result->image;
    if (result->display.planes)
        weighted_mean_divide(&result->display, r->params.samples,
                             weighted_mean_scale(r->params.settings));
    if (image_find(image, frame_beauty.planes[0]))
        accumulate_mean(image, &frame_beauty, r->params.samples);
    for (uint32_t i = 0; techniques_layer(i); i++) {
        if (renderer_wants_layer(r, i))
            accumulate_mean(image, techniques_layer(i), r->params.samples);
    }
    return renderer_denoise_end(r, result);
}

enum status renderer_finish_display(struct renderer *r, struct render_result *result)
{
    const struct settings *settings = r->params.settings;
    if (result->display.planes && weighted_mean_is_filtered(settings) &&
        !weighted_mean_filter(&result->display, weighted_mean_scale(settings)))
        return log_out_of_memory(NULL);
    return r->resolve.exec ? resolve_display(r, render_result_display(result), &result->rgba)
                           : STATUS_OK;
}

enum status renderer_render(struct renderer *r, const struct renderer_shot *shot,
                            struct render_result *result, renderer_progress_fn *progress,
                            void *user)
{
    *result = (struct render_result){ 0 };
    return renderer_render_again(r, shot, result, progress, user);
}

enum status renderer_render_again(struct renderer *r, const struct renderer_shot *shot,
                                  struct render_result *result, renderer_progress_fn *progress,
                                  void *user)
{
    if (!renderer_is_interleaved(&r->params))
        r->tile = tile_at(&r->tiling, shot->tile);
    enum status status = STATUS_OK;
    if (!add_planes(r, result))
        status = log_out_of_memory(NULL);
    else if (r->params.is_adaptive)
        status = renderer_draw_adaptive(r, shot, result, progress, user);
    else
        status = draw_samples(r, shot, result, progress, user);
    if (status == STATUS_OK)
        status = divide_sums(r, result);
    if (status == STATUS_OK && (r->resolve.exec || result->display.planes)) {
        if (r->params.columns * r->params.rows == 1)
            status = renderer_finish_display(r, result);
    } else if (status == STATUS_OK && r->params.display) {
        result->rgba = malloc((size_t)r->tile.width * r->tile.height * 4);
        if (result->rgba)
            copy_pixels(renderer_read_back(&r->image, &frame_display, r->last_slot), r->tile.width,
                        result->rgba, r->tile.width, &r->tile);
        else
            status = log_out_of_memory(NULL);
    }
    if (status != STATUS_OK)
        render_result_finish(result);
    return status;
}

const struct image *render_result_display(const struct render_result *result)
{
    return result->display.planes ? &result->display : &result->image;
}

void render_result_clear(struct render_result *result, uint32_t width, uint32_t height)
{
    struct image image = result->image, display = result->display;
    free(result->rgba);
    free(result->rgba_16);
    image_clear(&image, width, height);
    image_clear(&display, width, height);
    *result = (struct render_result){ .image = image, .display = display };
}

void render_result_finish(struct render_result *result)
{
    image_finish(&result->image);
    image_finish(&result->display);
    free(result->rgba);
    free(result->rgba_16);
    *result = (struct render_result){ 0 };
}
