/* frame_plan.c: tables made at run time around the techniques' own. */
#include "src/frame_plan.h"
#include <stdio.h>
#include "graph/rg_cmd.h"
#include "src/frame.h"
#include "src/log.h"
#include "src/tech/background.h"
#include "src/tech/bump.h"
#include "src/tech/env_cube.h"
#include "src/tech/tonemap.h"

/* The rows made below name the image first, then the buffer. */
static void record_readback(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct rg_use *uses = rg_cmd_pass(cmd)->uses;
    (void)frame;
    rg_cmd_copy_image_to_buffer(cmd, uses[0].image, uses[1].buffer, 0);
}

/* Asks for an image back, once however often it is asked for. */
static void want(struct frame_plan *p, const struct rg_image *image)
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
        .size_per_texel = (image->cube ? 6 : (VkDeviceSize)1) * rg_format_info(image->format)->size,
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

/* A technique that is switched off leaves its layers undrawn. */
static bool is_drawn(const struct frame_plan *p, const struct rg_image *image)
{
    for (size_t t = 0; image && t < p->technique_count; t++) {
        const struct rg_technique *technique = p->techniques[t];
        for (size_t i = 0; i < technique->pass_count; i++) {
            for (uint32_t c = 0; c < technique->passes[i].color_count; c++) {
                if (technique->passes[i].color[c].image == image)
                    return true;
            }
        }
    }
    return false;
}

static void keep(struct frame_plan *p, const struct rg_image *image)
{
    p->outputs[p->output_count++] = (struct rg_output){ .image = image, .access = RG_SAMPLED };
}

static void want_all(struct frame_plan *p, const struct frame_request *request)
{
    if (request->beauty)
        want(p, frame_beauty.image);
    for (uint32_t i = 0; frame_layers[i].name; i++) {
        if (request->layers & 1u << i && is_drawn(p, frame_layers[i].image))
            want(p, frame_layers[i].image);
    }
    if (request->display)
        want(p, &tonemap_color);
    if (request->cube_back)
        want(p, &env_cube_baked);
    if (request->keep_cube)
        keep(p, &env_cube_color);
    if (request->keep_display)
        keep(p, &tonemap_color);
}

static bool makes_cube(const struct frame_plan *p)
{
    return is_drawn(p, &env_cube_color) || is_drawn(p, &env_cube_baked);
}

static void bring(struct frame_plan *p, const struct frame_request *request)
{
    p->imports[FRAME_IMPORT_ENVIRONMENT] = (struct rg_import){
        .image = &frame_environment,
        .access = RG_SAMPLED,
        .extent = request->environment,
        .mips = request->environment_mips,
    };
    p->imports[FRAME_IMPORT_TEXTURES] = (struct rg_import){
        .image = &frame_textures,
        .access = RG_SAMPLED,
        .extent = { request->texture_size, request->texture_size },
        .layers = request->texture_count,
        .mips = request->texture_mips,
    };
    p->imports[FRAME_IMPORT_BUMP_MAP] = (struct rg_import){
        .image = &bump_map,
        .access = RG_SAMPLED,
        .extent = { request->bump_size, request->bump_size },
        .mips = request->bump_mips,
    };
    p->imports[FRAME_IMPORT_AIR] = (struct rg_import){
        .image = &frame_air,
        .access = RG_SAMPLED,
        .extent = { request->air_size, request->air_size },
        .layers = request->air_count,
        .mips = request->air_mips,
    };
    p->imports[FRAME_IMPORT_CUBE] = (struct rg_import){ .image = &env_cube_color,
                                                        .access = RG_SAMPLED,
                                                        .extent = request->cube };
    p->import_count = makes_cube(p) ? FRAME_IMPORT_CUBE : FRAME_IMPORT_COUNT;
}

static enum status report_faults(const struct rg_plan *plan)
{
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        char text[512];
        rg_fault_text(&plan->faults[i], text, sizeof(text));
        log_error("the frame's tables: %s", text);
    }
    return STATUS_FAILED;
}

enum status frame_plan_init(struct frame_plan *p, const struct frame_request *request)
{
    *p = (struct frame_plan){ 0 };
    for (; request->list.techniques[p->technique_count]; p->technique_count++)
        p->techniques[p->technique_count] = &request->list.techniques[p->technique_count]->graph;
    want_all(p, request);
    bring(p, request);
    p->readback = (struct rg_technique){ "readback", p->readback_passes, p->readback_count };
    p->techniques[p->technique_count++] = &p->readback;

    const struct rg_compile_params params = {
        .techniques = p->techniques,
        .technique_count = p->technique_count,
        .view = request->view,
        .max_region = request->part,
        .outputs = p->outputs,
        .output_count = p->output_count,
        .imports = p->imports,
        .import_count = p->import_count,
        .device = request->device,
        .sharing = request->sharing,
    };
    p->plan = rg_compile(&params);
    if (!p->plan) {
        log_error("out of memory while compiling the frame");
        return STATUS_TRY_AGAIN;
    }
    return p->plan->fault_count ? report_faults(p->plan) : STATUS_OK;
}

void frame_plan_finish(struct frame_plan *p)
{
    rg_plan_destroy(p->plan);
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
