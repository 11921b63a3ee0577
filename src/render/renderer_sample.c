/* renderer_sample.c: submits samples of an image and of the environment cube, and reads them back.
 */
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "graph/rg_firn.h"
#include "src/render/adaptive_sampling.h"
#include "src/render/frame/thin_lens.h"
#include "src/render/make_frame_request.h"
#include "src/render/renderer_internal.h"
#include "src/render/sample_accumulation.h"
#include "src/render/weighted_mean.h"
#include "src/settings/scene_settings.h"

/* Returns the offset of a tile's pixel from its block's centre, in image pixels. Tiles are
 * interleaved: each block of columns x rows pixels has one pixel of each tile. */
static vec2s tile_offset(const struct renderer_params *params, uint32_t tile)
{
    if (!renderer_is_interleaved(params))
        return (vec2s){ { 0.0f, 0.0f } };
    const uint32_t column = tile % params->columns, row = tile / params->columns;
    return (vec2s){ { (float)column + 0.5f - (float)params->columns / 2.0f,
                      (float)row + 0.5f - (float)params->rows / 2.0f } };
}

/* Returns true if photons of the light maps are ray traced, which dominates the time of small
 * images. */
static bool traces_photons(const struct renderer *r)
{
    const struct technique *refraction = r->params.refraction;
    return refraction && refraction->refraction.trace_photons;
}

/* Returns the sample whose light maps a sample uses. On a stage, whose light is soft, 8 samples
 * share them. */
static uint32_t light_sample(const struct renderer *r, uint32_t sample)
{
    const uint32_t shared = 8;
    if (box_diagonal(r->params.scene->stage_box) > 0.0f)
        return shared * adaptive_light_sample(sample / shared);
    if (r->params.is_adaptive)
        return adaptive_light_sample(sample);
    return traces_photons(r) ? even_light_sample(sample) : sample;
}

/* Fills the globals buffer and those upload buffers of techniques that the plan contains. */
static void write_uploads(const struct frame_view *view, const struct globals *globals,
                          struct rg_exec *exec, uint32_t slot)
{
    void *memory = rg_exec_mapped(exec, &frame_globals, slot);
    if (memory)
        memcpy(memory, globals, sizeof(*globals));
    for (const struct technique *const *t = techniques; *t; t++) {
        for (const struct technique_upload *u = (*t)->uploads; u && u->buffer; u++) {
            memory = rg_exec_mapped(exec, u->buffer, slot);
            if (memory)
                u->write(memory, view, globals);
        }
    }
}

/* Returns the image area where shaders may look up the object's faces. A margin allows for lookups
 * just outside the object. If there are output layers or pools, returns the whole image. */
static VkRect2D lookup_area(const struct renderer *r, const struct frame_view *view,
                            const struct globals *globals, VkExtent2D size)
{
    const struct technique *refraction = r->params.refraction; /* NULL: only the cube */
    const bool is_all = !refraction || refraction->refraction.reach > 0.0f || r->params.layers ||
                        view->scene->has_pool;
    return is_all ? (VkRect2D){ .extent = size }
                  : frame_view_box_area(view, globals, view->scene->box, size, 0.05f);
}

/* Restricts the next frame to the current tile and the pixels that rays of the tile may look up. */
static void restrict_to_tile(const struct renderer *r, const struct frame_view *view,
                             const struct globals *globals)
{
    const struct tile *t = &r->tile;
    const struct rg_exec_region region = {
        .region = { { (int32_t)t->x, (int32_t)t->y }, { t->width, t->height } },
        .reach = frame_view_reach(view, globals, r->params.refraction->refraction.reach),
    };
    if (r->tiling.columns * r->tiling.rows > 1 || r->params.is_adaptive)
        rg_exec_set_region(r->image.exec, &region);
}

enum status renderer_begin_frame(struct renderer *r, struct compiled_frame *compiled_frame,
                                 const struct renderer_shot *shot, uint32_t sample,
                                 struct renderer_frame *f, uint32_t *slot)
{
    const struct uploaded_scene *s = r->scene;
    struct frame_view *view = &f->view;
    *view = (struct frame_view){
        .scene = r->params.scene,
        .settings = r->params.settings,
        .camera = shot->camera,
        .time = shot->time,
        .width = r->width,
        .height = r->height,
        .jitter = pixel_filter_offset(r->params.filter, sample),
        .light_jitter = pixel_filter_jitter(light_sample(r, sample)),
        .lod_bias = renderer_is_interleaved(&r->params)
                        ? -0.5f * log2f((float)(r->params.columns * r->params.rows))
                        : 0.0f,
        .face_size = r->params.face_size,
        .sample = sample,
    };
    frame_lens_apply(view);
    view->jitter = glms_vec2_add(view->jitter, tile_offset(&r->params, shot->tile));
    view->previous_clip_from_world = frame_view_previous_clip_from_world(view, &shot->earlier);
    f->graph = (struct rg_frame){
        .settings = r->params.settings,
        .scene = r->params.scene,
        .object = uploaded_scene_mesh(&s->object, r->params.is_coarse),
        .surroundings = uploaded_scene_mesh(&s->surroundings, r->params.is_coarse),
        .objects = compiled_frame == &r->image ? r->objects.all : NULL,
        .object_count = compiled_frame == &r->image ? r->objects.count : 0,
        .meshes = r->meshes,
        .view = frame_view_push(view),
        .time = shot->time,
        .light_jitter = view->light_jitter,
        .skips_readback = r->skips_readback,
    };
    f->globals = frame_view_globals(view, &f->graph.view);
    f->globals.sample_random = pixel_filter_jitter(sample).x + 0.5f;
    for (uint32_t face = 0; face < 6; face++)
        f->graph.faces[face] = frame_view_face(view, face);
    const VkExtent2D size = compiled_frame->frame->plan->view;
    f->graph.object_area = frame_view_box_area(view, &f->globals, view->scene->box, size, 0.0f);
    f->graph.lookup_area = lookup_area(r, view, &f->globals, size);
    f->graph.ground_area = frame_view_reflection_area(view, &f->globals, size);
    f->graph.due = compiled_frame == &r->image ? frame_cube_due(&r->cube, view, &f->globals)
                                               : (struct frame_updates){ true, true };
    const VkResult result = rg_exec_begin(compiled_frame->exec, slot);
    if (result != VK_SUCCESS)
        return gpu_status(result);
    write_uploads(view, &f->globals, compiled_frame->exec, *slot);
    if (compiled_frame == &r->image) {
        frame_objects_place(&r->objects, compiled_frame, *slot, view, &f->globals,
                            r->params.refraction ? r->params.refraction->refraction.reach : 0.0f);
        restrict_to_tile(r, view, &f->globals);
    }
    return STATUS_OK;
}

void renderer_mark_drawn(struct renderer *r, const struct renderer_frame *f)
{
    frame_cube_mark_drawn(&r->cube, &f->view, &f->globals, f->graph.due);
}

void renderer_add_sample(struct renderer *r)
{
    const struct tile all = { .width = r->params.width, .height = r->params.height };
    const void *texels = renderer_read_back(&r->image, frame_beauty.image, r->last_slot);
    if (r->sample == SAMPLE_DRAWN && r->display_sums.planes)
        weighted_mean_add(&r->display_sums, &all, texels, weighted_mean_scale(r->params.settings));
    if (r->sample == SAMPLE_WEIGHTED) {
        accumulate_sample(&r->sums, &all, &frame_beauty, texels, r->partial.view.sample);
        r->sum_count = r->partial.view.sample + 1;
    }
    r->sample = r->sample == SAMPLE_DRAWN ? SAMPLE_WEIGHTED : SAMPLE_NONE;
}

enum status renderer_abandon(struct renderer *r)
{
    if (r->sample == SAMPLE_WEIGHTED) {
        renderer_add_sample(r);
        r->sample = SAMPLE_ADDED;
    } else if (r->sample == SAMPLE_DRAWN) {
        r->sample = SAMPLE_NONE;
    }
    if (!r->is_partial)
        return STATUS_OK;
    r->is_partial = false;
    r->cube.is_drawn = r->cube.is_drawn && !r->partial.graph.due.cube;
    r->cube.has_light = r->cube.has_light && !r->partial.graph.due.light;
    return gpu_status(rg_exec_abandon(r->image.exec));
}

enum status renderer_run(struct renderer *r, struct compiled_frame *compiled_frame,
                         const struct renderer_shot *shot, uint32_t sample, uint32_t *slot)
{
    struct renderer_frame frame;
    enum status status = renderer_abandon(r);
    if (status == STATUS_OK)
        status = renderer_begin_frame(r, compiled_frame, shot, sample, &frame, slot);
    if (status == STATUS_OK)
        status = gpu_status(rg_exec_submit(compiled_frame->exec, &frame.graph));
    if (status == STATUS_OK && compiled_frame == &r->image)
        renderer_mark_drawn(r, &frame);
    return status;
}

const void *renderer_read_back(struct compiled_frame *compiled_frame, const struct rg_image *image,
                               uint32_t slot)
{
    const struct rg_buffer *buffer = frame_plan_buffer(compiled_frame->frame, image);
    return buffer ? rg_exec_mapped(compiled_frame->exec, buffer, slot) : NULL;
}

bool renderer_wants_layer(const struct renderer *r, uint32_t layer)
{
    return r->params.layers & UINT64_C(1) << layer;
}

enum status renderer_read_sample(struct renderer *r, struct render_result *result,
                                 const struct tile *tile, uint32_t sample, uint32_t slot)
{
    struct image *image = &result->image;
    enum status status = gpu_status(rg_exec_wait(r->image.exec, slot));
    if (status != STATUS_OK)
        return status;
    const void *beauty = renderer_read_back(&r->image, frame_beauty.image, slot);
    if (beauty && image_find(image, frame_beauty.planes[0]))
        accumulate_sample(image, tile, &frame_beauty, beauty, sample);
    if (beauty && result->display.planes)
        weighted_mean_add(&result->display, tile, beauty, weighted_mean_scale(r->params.settings));
    for (uint32_t i = 0; techniques_layer(i); i++) {
        const void *texels = renderer_read_back(&r->image, techniques_layer(i)->image, slot);
        if (renderer_wants_layer(r, i) && texels)
            accumulate_sample(image, tile, techniques_layer(i), texels, sample);
    }
    renderer_denoise_accumulate(r, tile, sample, slot);
    return STATUS_OK;
}

enum status renderer_capture_cube(struct renderer *r, const struct renderer_shot *shot)
{
    const struct motion_params *motion = settings_of(r->params.settings, &motion_settings);
    const struct renderer_shot first = { .camera = shot->camera, .time = motion->time };
    uint32_t slot;
    if (!r->capture.exec || r->captured)
        return STATUS_OK;
    enum status status = renderer_run(r, &r->capture, &first, 0, &slot);
    r->captured = status == STATUS_OK;
    return status;
}
