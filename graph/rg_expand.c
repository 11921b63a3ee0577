/*
 * rg_expand.c: rows become passes (one for each repetition), uses and targets become accesses.
 * What is wrong with a row together with those before it is found on the way.
 */
#include "graph/rg_internal.h"

static const VkPipelineStageFlags2 shader_stages[] = {
    [RG_RASTER] = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    [RG_COMPUTE] = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    [RG_TRANSFER] = VK_PIPELINE_STAGE_2_NONE,
};

/* The pass being made. */
struct expansion {
    struct compiler *c;
    struct pass *pass;
    struct place place;
    uint32_t target_samples; /* 0: no target yet */
};

static void fault(const struct expansion *e, enum rg_error error, const struct resource *r,
                  const char *hint)
{
    struct place place = e->place;
    place.resource = rg_resource_name(r);
    rg_fault_add(e->c, error, place, hint);
}

/* ---- what an access finds and leaves ---- */

static bool is_filled(const struct compiler *c, const struct cell *cell, const struct pass *pass)
{
    return cell->filled == CELL_FILLED ||
           (cell->filled >= CELL_FILLED_BY &&
            c->passes[cell->filled - CELL_FILLED_BY].rg->when == pass->rg->when);
}

enum {
    FOUND_CONFLICT = 1 << 0,
    FOUND_NOTHING = 1 << 1,
};

/* The access is c->accesses[c->access_count]. Returns what is wrong. */
static unsigned enter_cell(struct compiler *c, const struct pass *pass, struct cell *cell,
                           const struct access *a)
{
    unsigned found = 0;
    uint32_t last = cell->last_access;
    cell->last_access = c->access_count + 1;
    if (last > pass->first_access) {
        const struct access *b = &c->accesses[last - 1];
        if (((a->flags | b->flags) & ACCESS_WRITES_CONTENT) || a->layout != b->layout)
            found |= FOUND_CONFLICT;
    }
    if ((a->flags & ACCESS_READS_CONTENT) && !is_filled(c, cell, pass))
        found |= FOUND_NOTHING;
    if (!(a->flags & ACCESS_WRITES_CONTENT))
        return found;
    if (!pass->rg->when)
        cell->filled = CELL_FILLED;
    else if (!is_filled(c, cell, pass))
        cell->filled = CELL_FILLED_BY + c->pass_count;
    return found;
}

static void report(const struct expansion *e, const struct resource *r, unsigned found,
                   const char *hint)
{
    if (found & FOUND_CONFLICT)
        fault(e, RG_ERROR_CONFLICT, r,
              "split the pass in two, or read another mip, layer or image");
    if (found & FOUND_NOTHING)
        fault(e, RG_ERROR_READ_BEFORE_WRITE, r, hint);
}

static bool in_range(const struct resource *r, const VkImageSubresourceRange *range)
{
    return range->aspectMask && !(range->aspectMask & ~r->aspects) && range->levelCount &&
           range->layerCount && range->baseMipLevel < r->mips &&
           range->levelCount <= r->mips - range->baseMipLevel &&
           range->baseArrayLayer < r->layers &&
           range->layerCount <= r->layers - range->baseArrayLayer;
}

/* Appends an access to the pass, unless its range is a fault. */
static void add_access(struct expansion *e, struct access *a, const char *unfilled_hint)
{
    struct compiler *c = e->c;
    const struct resource *r = &c->resources[a->resource];
    a->whole = r->cell_count == 1;
    if (r->image && !in_range(r, &a->range)) {
        fault(e, RG_ERROR_RANGE, r, "name a mip, layer and aspect that the image has");
        return;
    }
    VkImageAspectFlags aspects = a->range.aspectMask;
    if ((aspects & (aspects - 1)) && rg_is_shader_access(a->access))
        fault(e, RG_ERROR_RANGE, r, "a shader sees one aspect: name depth or stencil");
    if (!ARENA_ROOM(c->arena, c->accesses, c->access_count, c->access_room, 256))
        return;
    unsigned found = 0;
    if (a->whole) {
        found = enter_cell(c, e->pass, r->cells, a);
    } else {
        for (struct cell_walk w = rg_walk(r, a); rg_walk_next(&w);)
            found |= enter_cell(c, e->pass, w.cell, a);
    }
    if (found)
        report(e, r, found, unfilled_hint);
    c->accesses[c->access_count++] = *a;
    e->pass->access_count++;
}

/* ---- targets ---- */

static VkExtent2D mip_extent(const struct resource *r, uint32_t mip)
{
    VkExtent2D extent = { mip < 32 ? r->extent.width >> mip : 0,
                          mip < 32 ? r->extent.height >> mip : 0 };
    return (VkExtent2D){ extent.width ? extent.width : 1, extent.height ? extent.height : 1 };
}

static void check_extent(struct expansion *e, const struct resource *r, uint32_t mip)
{
    VkExtent2D extent = mip_extent(r, mip);
    if (e->pass->access_count == 0 && !e->target_samples)
        e->pass->extent = extent;
    else if (extent.width != e->pass->extent.width || extent.height != e->pass->extent.height)
        fault(e, RG_ERROR_TARGET_SIZE, r, "all targets of a pass are of one size");
}

static void check_target(struct expansion *e, const struct rg_target *target,
                         const struct resource *r, uint32_t mip)
{
    const struct rg_pass *rg = e->pass->rg;
    bool is_depth = target == &rg->depth;
    uint32_t samples = r->image->samples ? r->image->samples : 1;
    if (mip < r->mips)
        check_extent(e, r, mip);
    if (!(r->aspects & VK_IMAGE_ASPECT_COLOR_BIT) != is_depth)
        fault(e, RG_ERROR_FORMAT, r,
              is_depth ? "a depth target needs a depth format"
                       : "a colour target needs a colour format");
    if (is_depth && rg->depth_read_only && target->load != RG_LOAD_KEEP)
        fault(e, RG_ERROR_ACCESS, r, "depth that is only tested is RG_LOAD_KEEP");
    if (is_depth && target->resolve)
        fault(e, RG_ERROR_SAMPLES, r, "only colour is resolved; read depth by texelFetch");
    if (e->target_samples && samples != e->target_samples)
        fault(e, RG_ERROR_SAMPLES, r, "all targets of a pass have as many samples");
    e->target_samples = samples;
}

/* A repeated row's mip or layer: an image with a single one serves every repetition. */
static VkImageSubresourceRange target_range(const struct pass *pass, const struct resource *r,
                                            uint32_t mip, uint32_t layer)
{
    if (pass->rg->repeat == RG_PER_LAYER && r->layers > 1)
        layer += pass->repetition;
    if (pass->rg->repeat == RG_PER_MIP && r->mips > 1)
        mip += pass->repetition;
    return (VkImageSubresourceRange){ r->aspects, mip, 1, layer, 1 };
}

static void add_resolve(struct expansion *e, const struct rg_target *target)
{
    const struct rg_access_info *info = &rg_access_table[RG_RESOLVE];
    uint32_t index = rg_resource_of(e->c, target->resolve, NULL);
    if (index == RG_NONE)
        return;
    const struct resource *r = &e->c->resources[index];
    struct access access = {
        .resource = index,
        .access = RG_RESOLVE,
        .flags =
            ACCESS_WRITES_CONTENT | (e->pass->rg->when ? ACCESS_CONDITIONAL : ACCESS_OVERWRITES),
        .layout = info->layout,
        .stages = info->stages,
        .declared = target,
        .range = target_range(e->pass, r, target->resolve_mip, target->resolve_layer),
    };
    if (r->image->samples > 1)
        fault(e, RG_ERROR_SAMPLES, r, "resolve to an image of one sample a texel");
    if (target->image->samples <= 1)
        fault(e, RG_ERROR_SAMPLES, r, "resolve from an image of several samples a texel");
    if (r->image->format != target->image->format)
        fault(e, RG_ERROR_FORMAT, r, "resolve to an image of the same format");
    check_extent(e, r, access.range.baseMipLevel);
    add_access(e, &access, NULL);
}

static void add_target(struct expansion *e, const struct rg_target *target)
{
    const struct rg_pass *rg = e->pass->rg;
    enum rg_access kind = target != &rg->depth  ? RG_COLOR
                          : rg->depth_read_only ? RG_DEPTH_READ
                                                : RG_DEPTH;
    const struct rg_access_info *info = &rg_access_table[kind];
    uint32_t index = rg_resource_of(e->c, target->image, NULL);
    if (index == RG_NONE)
        return;
    const struct resource *r = &e->c->resources[index];
    bool keeps = target->load == RG_LOAD_KEEP;
    unsigned flags = rg->when ? ACCESS_CONDITIONAL : 0;
    if (keeps || target->blend || kind != RG_COLOR)
        flags |= ACCESS_READS;
    if (keeps || kind == RG_DEPTH_READ)
        flags |= ACCESS_READS_CONTENT;
    if (info->writes_content)
        flags |= ACCESS_WRITES_CONTENT | (keeps || rg->when ? 0 : ACCESS_OVERWRITES);
    struct access access = {
        .resource = index,
        .access = (uint8_t)kind,
        .flags = (uint8_t)flags,
        .visibility = kind == RG_DEPTH_READ ? rg_visibility(kind, info->stages) : 0,
        .layout = info->layout,
        .stages = info->stages,
        .declared = target,
        .range = target_range(e->pass, r, target->mip, target->layer),
    };
    check_target(e, target, r, access.range.baseMipLevel);
    add_access(e, &access, "clear it, or put the pass that fills it before this one");
    if (target->resolve && target != &rg->depth)
        add_resolve(e, target);
}

/* ---- uses ---- */

static VkImageSubresourceRange use_range(const struct resource *r, const struct rg_range *range,
                                         const struct pass *pass)
{
    VkImageSubresourceRange out = {
        .aspectMask = range->aspect ? range->aspect : r->aspects,
        .baseMipLevel = range->mip,
        .levelCount = range->mip_count,
        .baseArrayLayer = range->layer,
        .layerCount = range->layer_count,
    };
    if (range->each && pass->rg->repeat == RG_PER_LAYER) {
        out.baseArrayLayer += pass->repetition;
        out.layerCount = 1;
    } else if (range->each && pass->rg->repeat == RG_PER_MIP) {
        out.baseMipLevel += pass->repetition;
        out.levelCount = 1;
    }
    if (!out.levelCount && out.baseMipLevel < r->mips)
        out.levelCount = r->mips - out.baseMipLevel;
    if (!out.layerCount && out.baseArrayLayer < r->layers)
        out.layerCount = r->layers - out.baseArrayLayer;
    return out;
}

static VkPipelineStageFlags2 use_stages(const struct rg_pass *rg, const struct rg_use *use,
                                        const struct rg_access_info *info)
{
    if (info->stages)
        return info->stages;
    if (use->stages)
        return use->stages;
    VkPipelineStageFlags2 stages = shader_stages[rg_kind_of(rg)];
    if (use->access == RG_UNIFORM && rg->kind == RG_RASTER)
        stages |= VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
    return stages;
}

static void add_use(struct expansion *e, const struct rg_use *use)
{
    const struct rg_pass *rg = e->pass->rg;
    const struct rg_access_info *info = &rg_access_table[use->access];
    uint32_t index = rg_resource_of(e->c, use->image, use->buffer);
    if (index == RG_NONE)
        return;
    const struct resource *r = &e->c->resources[index];
    unsigned flags = (info->reads ? ACCESS_READS : 0) | (rg->when ? ACCESS_CONDITIONAL : 0);
    if (info->reads_content)
        flags |= ACCESS_READS_CONTENT;
    if (info->writes_content)
        flags |= ACCESS_WRITES_CONTENT;
    if (info->writes_content && !info->reads_content && !use->partial && !rg->when)
        flags |= ACCESS_OVERWRITES;
    struct access access = {
        .resource = index,
        .access = (uint8_t)use->access,
        .flags = (uint8_t)flags,
        .stages = use_stages(rg, use, info),
        .declared = use,
    };
    if (!info->writes_content)
        access.visibility = rg_visibility(use->access, access.stages);
    if (r->image) {
        access.layout = info->layout;
        access.range = use_range(r, &use->range, e->pass);
    }
    add_access(e, &access, "put the pass that writes it before this one, or import it");
}

/* ---- rows ---- */

static void add_pass(struct compiler *c, struct place place, uint32_t technique,
                     uint32_t repetition)
{
    const struct rg_pass *rg = &place.technique->passes[place.row];
    if (!ARENA_ROOM(c->arena, c->passes, c->pass_count, c->pass_room, 64))
        return;
    c->passes[c->pass_count] = (struct pass){
        .technique = technique,
        .row = place.row,
        .repetition = repetition,
        .rg = rg,
        .extent = c->params->view,
        .first_access = c->access_count,
    };
    struct expansion e = { .c = c, .pass = &c->passes[c->pass_count], .place = place };
    for (size_t i = 0; i < RG_COLOR_COUNT && rg->color[i].image; i++)
        add_target(&e, &rg->color[i]);
    if (rg->depth.image)
        add_target(&e, &rg->depth);
    for (const struct rg_use *use = rg->uses; use && rg_is_use(use); use++) {
        if (rg_is_good_use(use))
            add_use(&e, use);
    }
    c->pass_count++;
}

/* The layers or mips of a row's first image written, from the first one named; at least 1, so that
 * a first one that is not there becomes a fault of ranges. 0: there is no such image. */
static uint32_t repetition_count(struct compiler *c, const struct rg_pass *pass)
{
    const struct rg_target *target = pass->color[0].image ? &pass->color[0] : &pass->depth;
    const struct rg_image *image = target->image;
    uint32_t mip = target->mip;
    uint32_t layer = target->layer;
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use) && !image; use++) {
        if (rg_is_good_use(use) && rg_access_table[use->access].writes_content) {
            image = use->image;
            mip = use->range.mip;
            layer = use->range.layer;
        }
    }
    uint32_t index = image ? rg_resource_of(c, image, NULL) : RG_NONE;
    if (index == RG_NONE)
        return 0;
    const struct resource *r = &c->resources[index];
    if (pass->repeat == RG_PER_LAYER)
        return r->layers > layer ? r->layers - layer : 1;
    return r->mips > mip ? r->mips - mip : 1;
}

static void expand_row(struct compiler *c, struct place place, uint32_t technique)
{
    const struct rg_pass *rg = &place.technique->passes[place.row];
    uint32_t count = rg->repeat == RG_ONCE ? 1 : repetition_count(c, rg);
    if (!count)
        rg_fault_add(c, RG_ERROR_REPEAT, place,
                     "a repeated row writes an image, whose layers or mips it counts");
    for (uint32_t i = 0; i < count && !c->arena->failed; i++)
        add_pass(c, place, technique, i);
}

void rg_expand(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    for (uint32_t t = 0; t < params->technique_count; t++) {
        const struct rg_technique *technique = params->techniques[t];
        if (!technique->name)
            rg_fault_add(c, RG_ERROR_NO_NAME, (struct place){ technique, RG_NONE, NULL },
                         "give the technique a name");
        for (uint32_t p = 0; p < technique->pass_count && !c->arena->failed; p++) {
            const struct place place = { technique, p, NULL };
            c->row_first_fault = c->fault_count;
            rg_check_row(c, &technique->passes[p], place);
            expand_row(c, place, t);
        }
    }
    c->row_first_fault = c->fault_count;
    for (uint32_t i = 0; i < c->resource_count; i++) {
        const struct resource *r = &c->resources[i];
        bool complete = true;
        for (uint32_t k = 0; k < r->cell_count && r->output != RG_NONE; k++)
            complete = complete && r->cells[k].filled == CELL_FILLED;
        if (!complete)
            rg_fault_add(
                c, RG_ERROR_OUTPUT_NOT_WRITTEN,
                (struct place){ .row = RG_NONE, .resource = rg_resource_name(r) },
                "list the technique whose passes write all of it, whatever conditions say");
    }
}
