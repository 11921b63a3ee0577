/*
 * expand.c: rows become passes (one for each repetition), uses and targets become accesses.
 *
 * Faults of a row by itself come first, then those of what it does together with other rows.
 */
#include "graph/compile/compiler.h"

/* The pass being made. */
struct expansion {
    struct compiler *c;
    struct pass *pass;
    struct fault_location location;
    uint32_t target_samples; /* 0: no target yet */
};

static void fault(const struct expansion *e, enum rg_error error, const struct resource *r,
                  const char *hint)
{
    struct fault_location location = e->location;
    location.resource = r->name;
    rg_fault_add(e->c, error, location, hint);
}

/* ---- what an access finds and leaves ---- */

static bool is_filled(const struct compiler *c, const struct cell *cell, const struct pass *pass)
{
    return cell->filled == CELL_FILLED ||
           (cell->filled >= CELL_FILLED_BY &&
            c->passes[cell->filled - CELL_FILLED_BY].rg->when == pass->rg->when);
}

/* Whether the pass accesses the cell already, in a way that the access contradicts. */
static bool is_conflict(const struct compiler *c, const struct pass *pass, const struct cell *cell,
                        const struct access *a)
{
    if (cell->last_access <= pass->first_access)
        return false;
    const struct access *before = &c->accesses[cell->last_access - 1];
    return ((a->flags | before->flags) & ACCESS_WRITES) || a->layout != before->layout;
}

static bool is_in_range(const struct resource *r, const VkImageSubresourceRange *range)
{
    return range->aspectMask && !(range->aspectMask & ~r->all.aspectMask) && range->levelCount &&
           range->layerCount && range->baseMipLevel < r->all.levelCount &&
           range->levelCount <= r->all.levelCount - range->baseMipLevel &&
           range->baseArrayLayer < r->all.layerCount &&
           range->layerCount <= r->all.layerCount - range->baseArrayLayer;
}

/* Makes the next access, which counts after keep_access(). NULL: memory is short. */
static struct access *next_access(struct expansion *e, struct resource *r, enum rg_access kind,
                                  bool reads, VkPipelineStageFlags2 stages)
{
    struct compiler *c = e->c;
    if (!r || !ARENA_ROOM(c->arena, c->accesses, c->access_count, c->access_room, c->row_count * 4))
        return NULL;
    struct access *a = &c->accesses[c->access_count];
    rg_access_init(a, r, kind, reads, stages);
    return a;
}

/* Adds the next access to the pass, unless its range is a fault. */
static void keep_access(struct expansion *e, const struct access *a, const char *unfilled_hint)
{
    struct compiler *c = e->c;
    struct pass *pass = e->pass;
    VkImageAspectFlags aspects = a->range.aspectMask;
    bool conflict = false;
    bool unfilled = false;
    if (!is_in_range(a->resource, &a->range)) {
        fault(e, RG_ERROR_RANGE, a->resource, "name a mip, layer and aspect that the image has");
        return;
    }
    if ((aspects & (aspects - 1)) && rg_is_shader_access(a->kind))
        fault(e, RG_ERROR_RANGE, a->resource, "a shader sees one aspect: name depth or stencil");
    for (struct cell_walk w = rg_cells(a->resource, &a->range); w.cell; rg_next_cell(&w)) {
        bool filled = is_filled(c, w.cell, pass);
        conflict = conflict || is_conflict(c, pass, w.cell, a);
        unfilled = unfilled || ((a->flags & ACCESS_READS) && !filled);
        if (a->flags & ACCESS_WRITES && !pass->rg->when)
            w.cell->filled = CELL_FILLED;
        else if (a->flags & ACCESS_WRITES && !filled)
            w.cell->filled = CELL_FILLED_BY + c->pass_count;
        w.cell->last_access = c->access_count + 1;
    }
    if (conflict)
        fault(e, RG_ERROR_CONFLICT, a->resource,
              "split the pass in two, or read another mip, layer or image");
    if (unfilled)
        fault(e, RG_ERROR_READ_BEFORE_WRITE, a->resource, unfilled_hint);
    c->access_count++;
}

/* A conditional pass leaves what it does not draw over. */
static void set_conditional(const struct expansion *e, struct access *a)
{
    if (!e->pass->rg->when)
        return;
    a->flags &= ~(uint32_t)ACCESS_OVERWRITES;
    a->flags |= ACCESS_CONDITIONAL;
}

/* ---- targets ---- */

static void check_extent(struct expansion *e, const struct resource *r, uint32_t mip)
{
    uint32_t width = mip < 32 ? r->extent.width >> mip : 0;
    uint32_t height = mip < 32 ? r->extent.height >> mip : 0;
    VkExtent2D extent = { width ? width : 1, height ? height : 1 };
    if (e->c->access_count == e->pass->first_access && !e->target_samples)
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
    if (mip < r->all.levelCount)
        check_extent(e, r, mip);
    if (!(r->all.aspectMask & VK_IMAGE_ASPECT_COLOR_BIT) != is_depth)
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
    if (pass->rg->repeat == RG_PER_LAYER && r->all.layerCount > 1)
        layer += pass->repetition;
    if (pass->rg->repeat == RG_PER_MIP && r->all.levelCount > 1)
        mip += pass->repetition;
    return (VkImageSubresourceRange){ r->all.aspectMask, mip, 1, layer, 1 };
}

static void add_resolve(struct expansion *e, const struct rg_target *target)
{
    struct resource *r = rg_resource_of(e->c, target->resolve, NULL);
    struct access *a = next_access(e, r, RG_RESOLVE, false, rg_access_table[RG_RESOLVE].stages);
    if (!a)
        return;
    a->declared = target;
    a->range = target_range(e->pass, r, target->resolve_mip, target->resolve_layer);
    a->flags |= ACCESS_OVERWRITES;
    if (e->pass->rg->when)
        a->flags = ACCESS_WRITES | ACCESS_CONDITIONAL;
    if (r->image->samples > 1)
        fault(e, RG_ERROR_SAMPLES, r, "resolve to an image of one sample a texel");
    if (target->image->samples <= 1)
        fault(e, RG_ERROR_SAMPLES, r, "resolve from an image of several samples a texel");
    if (r->image->format != target->image->format)
        fault(e, RG_ERROR_FORMAT, r, "resolve to an image of the same format");
    check_extent(e, r, a->range.baseMipLevel);
    keep_access(e, a, NULL);
}

static void add_target(struct expansion *e, const struct rg_target *target)
{
    const struct rg_pass *rg = e->pass->rg;
    enum rg_access kind = target != &rg->depth  ? RG_COLOR
                          : rg->depth_read_only ? RG_DEPTH_READ
                                                : RG_DEPTH;
    bool keeps = target->load == RG_LOAD_KEEP;
    bool reads = keeps || target->blend || kind != RG_COLOR;
    struct resource *r = rg_resource_of(e->c, target->image, NULL);
    struct access *a = next_access(e, r, kind, reads, rg_access_table[kind].stages);
    if (!a)
        return;
    a->declared = target;
    a->range = target_range(e->pass, r, target->mip, target->layer);
    if (keeps)
        a->flags |= ACCESS_READS;
    else if (a->flags & ACCESS_WRITES)
        a->flags |= ACCESS_OVERWRITES;
    set_conditional(e, a);
    check_target(e, target, r, a->range.baseMipLevel);
    keep_access(e, a, "clear it, or put the pass that fills it before this one");
    if (target->resolve && target != &rg->depth)
        add_resolve(e, target);
}

/* ---- uses ---- */

static VkImageSubresourceRange use_range(const struct resource *r, const struct rg_range *range,
                                         const struct pass *pass)
{
    VkImageSubresourceRange out = {
        .aspectMask = range->aspect ? range->aspect : r->all.aspectMask,
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
    if (!out.levelCount && out.baseMipLevel < r->all.levelCount)
        out.levelCount = r->all.levelCount - out.baseMipLevel;
    if (!out.layerCount && out.baseArrayLayer < r->all.layerCount)
        out.layerCount = r->all.layerCount - out.baseArrayLayer;
    return out;
}

static void add_use(struct expansion *e, const struct rg_use *use)
{
    struct resource *r = rg_resource_of(e->c, use->image, use->buffer);
    struct access *a = next_access(e, r, use->access, true, rg_use_stages(e->pass->rg, use));
    if (!a)
        return;
    a->declared = use;
    if (use->image)
        a->range = use_range(r, &use->range, e->pass);
    if ((a->flags & ACCESS_WRITES) && !(a->flags & ACCESS_READS) && !use->partial)
        a->flags |= ACCESS_OVERWRITES;
    set_conditional(e, a);
    keep_access(e, a, "put the pass that writes it before this one, or import it");
}

/* ---- rows ---- */

static void add_pass(struct expansion *e, const struct rg_pass *rg, uint32_t repetition)
{
    struct compiler *c = e->c;
    uint32_t color_count = rg_color_count(rg);
    if (!ARENA_ROOM(c->arena, c->passes, c->pass_count, c->pass_room, c->row_count))
        return;
    e->pass = &c->passes[c->pass_count];
    e->target_samples = 0;
    e->pass->technique = e->location.technique;
    e->pass->rg = rg;
    e->pass->row = e->location.row;
    e->pass->repetition = repetition;
    e->pass->extent = c->params->view;
    e->pass->first_access = c->access_count;
    e->pass->first_fallback = c->fallback_count;
    c->color_count += color_count;
    for (uint32_t i = 0; i < color_count; i++)
        add_target(e, &rg->color[i]);
    if (rg->depth.image)
        add_target(e, &rg->depth);
    for (const struct rg_use *use = rg->uses; use && rg_is_use(use); use++) {
        if (rg_is_good_use(use) && !rg_use_fallback(c, use))
            add_use(e, use);
    }
    e->pass->access_count = c->access_count - e->pass->first_access;
    e->pass->fallback_count = c->fallback_count - e->pass->first_fallback;
    c->pass_count++;
}

/* The layers or mips of a row's first image written, from the first one named; at least 1, so that
 * a first one that is not there becomes a fault of ranges. 0: there is no such image. */
static uint32_t repetition_count(struct compiler *c, const struct rg_pass *pass)
{
    const struct rg_target *target = rg_color_count(pass) ? pass->color : &pass->depth;
    const struct rg_image *image = target->image;
    uint32_t mip = target->mip;
    uint32_t layer = target->layer;
    if (pass->repeat == RG_ONCE)
        return 1;
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use) && !image; use++) {
        if (rg_is_good_use(use) && rg_access_table[use->access].writes_content) {
            image = use->image;
            mip = use->range.mip;
            layer = use->range.layer;
        }
    }
    const struct resource *r = image ? rg_resource_of(c, image, NULL) : NULL;
    if (!r)
        return 0;
    if (pass->repeat == RG_PER_LAYER)
        return r->all.layerCount > layer ? r->all.layerCount - layer : 1;
    return r->all.levelCount > mip ? r->all.levelCount - mip : 1;
}

static void check_pass_name(struct expansion *e, const struct rg_pass *rg)
{
    struct compiler *c = e->c;
    if (!rg->name) {
        rg_fault_add(c, RG_ERROR_NO_NAME, e->location, "give the pass a name");
        return;
    }
    void **known = rg_map_value(c->arena, &c->pass_names, rg->name);
    if (known && *known)
        rg_fault_add(c, RG_ERROR_DUPLICATE_NAME, e->location, "give each a name of its own");
    if (known)
        *known = c;
}

static void expand_row(struct expansion *e, const struct rg_pass *rg)
{
    struct compiler *c = e->c;
    c->row_first_fault = c->fault_count;
    check_pass_name(e, rg);
    rg_check_row(c, rg, e->location);
    uint32_t count = repetition_count(c, rg);
    if (!count)
        rg_fault_add(c, RG_ERROR_REPEAT, e->location,
                     "a repeated row writes an image, whose layers or mips it counts");
    for (uint32_t i = 0; i < count && !c->arena->failed; i++)
        add_pass(e, rg, i);
}

static void check_output(struct compiler *c, const struct resource *r)
{
    bool complete = true;
    for (uint32_t k = 0; k < r->cell_count; k++)
        complete = complete && r->cells[k].filled == CELL_FILLED;
    if (!complete)
        rg_fault_of(c, RG_ERROR_OUTPUT_NOT_WRITTEN, r->name,
                    "list the technique whose passes write all of it, whatever conditions say");
}

void rg_expand(struct compiler *c)
{
    for (uint32_t t = 0; t < c->params->technique_count; t++) {
        const struct rg_technique *technique = c->params->techniques[t];
        struct expansion e = { .c = c, .location = { technique, RG_NONE, NULL } };
        if (!technique->name)
            rg_fault_add(c, RG_ERROR_NO_NAME, e.location, "give the technique a name");
        for (uint32_t p = 0; p < technique->pass_count && !c->arena->failed; p++) {
            e.location.row = p;
            expand_row(&e, &technique->passes[p]);
        }
    }
    c->row_first_fault = c->fault_count;
    for (uint32_t i = 0; i < c->boundary_count; i++) {
        if (c->resources[i]->output != RG_NONE)
            check_output(c, c->resources[i]);
    }
}
