/* compile_frame_plan.c: assembles a frame's tables: passes of techniques, imports and readback. */
#include "src/render/frame/compile_frame_plan.h"
#include <stdio.h>
#include <stdlib.h>
#include "graph/rg_cmd.h"
#include "src/base/log.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"

/* Copies the image (first resource use of the pass) to the readback buffer (second use). */
static void record_readback(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct rg_use *uses = rg_cmd_pass(cmd)->uses;
    if (!frame->skips_readback)
        rg_cmd_copy_image_to_buffer(cmd, uses[0].image, uses[1].buffer, 0);
}

/* Adds a readback of the image, unless there is one already. */
static void add_readback(struct frame_plan *p, const struct rg_image *image)
{
    for (uint32_t i = 0; i < p->readback_count; i++) {
        if (p->readbacks[i].image == image)
            return;
    }
    uint32_t i = p->readback_count++;
    struct frame_readback *r = &p->readbacks[i];
    r->image = image;
    snprintf(r->name, sizeof(r->name), "readback.%s", image->name);
    r->buffer = (struct rg_buffer){
        .name = r->name,
        .size_per_texel = rg_format_info(image->format)->size,
        .memory = RG_MEMORY_READBACK,
    };
    r->uses[0] = (struct rg_use){ .image = image, .access = RG_COPY_SRC };
    r->uses[1] = (struct rg_use){ .buffer = &r->buffer, .access = RG_COPY_DST };
    p->readback_passes[i] = (struct rg_pass){
        .name = r->name,
        .kind = RG_TRANSFER,
        .uses = r->uses,
        .record = record_readback,
    };
    p->outputs[p->output_count++] =
        (struct rg_output){ .buffer = &r->buffer, .access = RG_HOST_READ };
}

/* Returns true if a pass draws the image. A disabled technique does not draw its layers. */
static bool is_drawn(const struct frame_plan *p, const struct rg_image *image)
{
    for (size_t t = 0; image && t < p->list.count; t++) {
        const struct rg_technique *technique = &p->list.pass_groups[t];
        for (size_t i = 0; i < technique->pass_count; i++) {
            for (uint32_t c = 0; c < technique->passes[i].color_count; c++) {
                if (technique->passes[i].color[c].image == image)
                    return true;
            }
        }
    }
    return false;
}

static void keep_on_device(struct frame_plan *p, const struct rg_image *image)
{
    p->outputs[p->output_count++] = (struct rg_output){ .image = image, .access = RG_SAMPLED };
}

static void add_outputs(struct frame_plan *p, const struct frame_request *request)
{
    if (request->beauty)
        add_readback(p, frame_beauty.image);
    const struct frame_layer *layer;
    for (size_t i = 0; i < FRAME_LAYER_MAX && (layer = techniques_layer(i)); i++) {
        if (request->layers & UINT64_C(1) << i && is_drawn(p, layer->image))
            add_readback(p, layer->image);
    }
    for (size_t i = 0; i < FRAME_DENOISE_COUNT && request->config.denoises_light; i++)
        add_readback(p, frame_denoise_layers[i].image);
    if (request->display)
        add_readback(p, &frame_display);
    if (request->keep_cube)
        keep_on_device(p, &frame_env_cube);
    if (request->keep_display)
        keep_on_device(p, &frame_display);
}

static uint32_t count_mips(const struct technique_texels *texels)
{
    uint32_t side = texels->width > texels->height ? texels->width : texels->height;
    uint32_t mips = 1;
    while (!texels->no_mips && (side >>= 1))
        mips++;
    return mips;
}

static struct rg_import describe(const struct technique_import *import, const struct scene *scene)
{
    if (import->is_structure)
        return (struct rg_import){ .buffer = import->buffer,
                                   .access = RG_TRACE,
                                   .size = import->buffer->size };
    if (import->buffer)
        return (struct rg_import){ .buffer = import->buffer,
                                   .access = import->buffer->format ? RG_SAMPLED : RG_STORAGE_READ,
                                   .size = import->find_bytes(scene, import->buffer).size };
    const struct technique_texels texels = import->find(scene);
    if (!texels.width)
        return (struct rg_import){ .image = import->image, .access = RG_SAMPLED };
    return (struct rg_import){
        .image = import->image,
        .access = RG_SAMPLED,
        .extent = { texels.width, texels.height },
        .layers = texels.layers,
        .mips = count_mips(&texels),
    };
}

/* Imports the scene's images, except for those that the plan draws. */
static bool import_all(struct frame_plan *p, const struct scene *scene)
{
    const struct technique_import *import;
    size_t count = 0;
    while (techniques_import(count))
        count++;
    p->imports = calloc(count + 1, sizeof(*p->imports));
    for (size_t i = 0; p->imports && (import = techniques_import(i)); i++) {
        if (!is_drawn(p, import->image))
            p->imports[p->import_count++] = describe(import, scene);
    }
    return p->imports;
}

static enum status report_faults(const struct rg_plan *plan)
{
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        char text[512];
        rg_fault_text(&plan->faults[i], text, sizeof(text));
        log_error("invalid frame tables: %s", text);
    }
    return STATUS_FAILED;
}

static enum status out_of_memory(void)
{
    log_error("out of memory while compiling the frame");
    return STATUS_TRY_AGAIN;
}

/* Fills the table of pass groups, leaving space for the readback passes. */
static bool list_techniques(struct frame_plan *p)
{
    p->techniques = calloc(p->list.count + 1, sizeof(const struct rg_technique *));
    for (size_t i = 0; i < p->list.count && p->techniques; i++)
        p->techniques[p->technique_count++] = &p->list.pass_groups[i];
    return p->techniques;
}

/* Returns the size of a buffer that has elements for the pixels of one tile only. */
static struct rg_size size_of_tile(const struct rg_buffer *buffer, VkExtent2D tile)
{
    return (struct rg_size){ .buffer = buffer,
                             .size = buffer->size_per_texel * tile.width * tile.height };
}

static enum status compile(struct frame_plan *p, const struct frame_request *request)
{
    const uint32_t side = request->face_size
                              ? request->face_size
                              : frame_face_size(request->config.settings, request->view.height);
    const VkExtent2D face = { side, side };
    struct rg_size sizes[FRAME_READBACK_COUNT + 3] = { { &frame_env_cube, face },
                                                       { &frame_env_cube_depth, face } };
    size_t size_count = 2;
    if (request->max_region.width) {
        sizes[size_count++] = size_of_tile(&frame_samples, request->max_region);
        for (uint32_t i = 0; i < p->readback_count; i++)
            sizes[size_count++] = size_of_tile(&p->readbacks[i].buffer, request->max_region);
    }
    const struct rg_compile_params params = {
        .techniques = p->techniques,
        .technique_count = p->technique_count,
        .view = request->view,
        .max_view = request->max_view,
        .outputs = p->outputs,
        .output_count = p->output_count,
        .imports = p->imports,
        .import_count = p->import_count,
        .sizes = sizes,
        .size_count = size_count,
        .device = request->device,
        .sharing = request->sharing,
    };
    p->max_region = request->max_region;
    p->plan = rg_compile(&params);
    if (!p->plan)
        return out_of_memory();
    return p->plan->fault_count ? report_faults(p->plan) : STATUS_OK;
}

/* Lists the images of the requested layers, and of those that techniques read. */
static void want_layers(struct technique_config *config, uint64_t layers)
{
    const struct frame_layer *layer;
    size_t count = 0;
    for (size_t i = 0; i < FRAME_LAYER_MAX && (layer = techniques_layer(i)); i++) {
        if (layers & UINT64_C(1) << i && layer->image)
            config->wanted[count++] = layer->image;
    }
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->reads_layer && (*t)->is_on(config->settings))
            config->wanted[count++] = (*t)->reads_layer;
    }
}

enum status frame_plan_init(struct frame_plan *p, const struct frame_request *request)
{
    struct technique_config config = request->config;
    *p = (struct frame_plan){ 0 };
    want_layers(&config, request->layers);
    enum status status = frame_list_init(&p->list, &config);
    if (status != STATUS_OK)
        return status;
    if (!list_techniques(p))
        return out_of_memory();
    add_outputs(p, request);
    if (!import_all(p, request->config.scene))
        return out_of_memory();
    p->readback = (struct rg_technique){ "readback", p->readback_passes, p->readback_count };
    p->techniques[p->technique_count++] = &p->readback;
    return compile(p, request);
}

enum status frame_plan_change_view(struct frame_plan *p, const struct frame_request *request,
                                   struct rg_plan **previous)
{
    struct rg_plan *before = p->plan;
    const enum status status = compile(p, request);
    *previous = before;
    if (status == STATUS_OK)
        return STATUS_OK;
    rg_plan_destroy(p->plan);
    p->plan = before;
    *previous = NULL;
    return status;
}

void frame_plan_finish(struct frame_plan *p)
{
    rg_plan_destroy(p->plan);
    free(p->imports);
    free(p->techniques);
    frame_list_finish(&p->list);
    *p = (struct frame_plan){ 0 };
}

const struct rg_buffer *frame_plan_buffer(const struct frame_plan *p, const struct rg_image *image)
{
    for (uint32_t i = 0; i < p->readback_count; i++) {
        if (p->readbacks[i].image == image)
            return &p->readbacks[i].buffer;
    }
    return NULL;
}
