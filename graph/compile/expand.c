/*
 * expand.c: rows become passes (one for each repetition), uses and targets become accesses.
 * What is wrong with a row together with those before it is found on the way.
 */
#include "graph/compile/name.h"

/* The pass being made. */
struct expansion {
    struct compiler *c;
    struct pass *pass;
    struct place place;
    uint32_t target_samples; /* 0: no target yet */
    unsigned flags;          /* of all uses */
    uint32_t next_binding;   /* of uses; none so far has it or a higher one */
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
static inline unsigned enter_cell(struct compiler *c, const struct pass *pass, struct cell *cell,
                                  const struct access *a)
{
    unsigned found = 0;
    uint32_t last = cell->last_access;
    cell->last_access = c->access_count + 1;
    if (last > pass->first_access) {
        const struct access *b = &c->accesses[last - 1];
        if (((a->flags | b->flags) & ACCESS_WRITES_CONTENT) ||
            a->effect->layout != b->effect->layout)
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
    return range->aspectMask && !(range->aspectMask & ~r->all.aspectMask) && range->levelCount &&
           range->layerCount && range->baseMipLevel < r->all.levelCount &&
           range->levelCount <= r->all.levelCount - range->baseMipLevel &&
           range->baseArrayLayer < r->all.layerCount &&
           range->layerCount <= r->all.layerCount - range->baseArrayLayer;
}

/* The next access, which does not count before keep_access(); NULL: memory is short. */
static struct access *next_access(struct compiler *c)
{
    return ARENA_ROOM(c->arena, c->accesses, c->access_count, c->access_room, 256)
               ? &c->accesses[c->access_count]
               : NULL;
}

static inline void keep_access(struct expansion *e, const struct resource *r, unsigned found,
                               const char *unfilled_hint)
{
    if (found)
        report(e, r, found, unfilled_hint);
    e->c->access_count++;
}

static bool is_same_range(const VkImageSubresourceRange *a, const VkImageSubresourceRange *b)
{
    return a->aspectMask == b->aspectMask && a->baseMipLevel == b->baseMipLevel &&
           a->levelCount == b->levelCount && a->baseArrayLayer == b->baseArrayLayer &&
           a->layerCount == b->layerCount;
}

static void set_range(struct compiler *c, struct access *a, const VkImageSubresourceRange *range)
{
    if (is_same_range(range, &a->resource->all) ||
        !ARENA_ROOM(c->arena, c->ranges, c->range_count, c->range_room, 64))
        return;
    c->ranges[c->range_count++] = *range;
    a->range = c->range_count;
}

/* For what no other access does; NULL: memory is short. */
static struct effect *new_effect(const struct compiler *c, const struct effect *effect)
{
    struct effect *new = ARENA_ARRAY(c->arena, struct effect, 1);
    if (new)
        *new = *effect;
    return new;
}

/* Appends the access to the pass, unless its range is a fault. */
static void add_access(struct expansion *e, struct access *a, const VkImageSubresourceRange *range,
                       const char *unfilled_hint)
{
    const struct resource *r = a->resource;
    VkImageAspectFlags aspects = range->aspectMask;
    unsigned found = 0;
    if (r->image && !in_range(r, range)) {
        fault(e, RG_ERROR_RANGE, r, "name a mip, layer and aspect that the image has");
        return;
    }
    if ((aspects & (aspects - 1)) && rg_is_shader_access(a->effect->access))
        fault(e, RG_ERROR_RANGE, r, "a shader sees one aspect: name depth or stencil");
    if (r->cell_count > 1)
        set_range(e->c, a, range);
    for (struct cell_walk w = rg_walk(r, range); rg_walk_next(&w);)
        found |= enter_cell(e->c, e->pass, w.cell, a);
    keep_access(e, r, found, unfilled_hint);
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
    const struct effect effect = rg_effect(RG_RESOLVE, false, rg_access_table[RG_RESOLVE].stages);
    const struct effect *kept = new_effect(e->c, &effect);
    struct resource *r = rg_resource_of(e->c, target->resolve, NULL);
    struct access *a = next_access(e->c);
    if (!r || !a || !kept)
        return;
    *a = (struct access){
        .resource = r,
        .effect = kept,
        .declared = target,
        .flags =
            ACCESS_WRITES_CONTENT | (e->pass->rg->when ? ACCESS_CONDITIONAL : ACCESS_OVERWRITES),
    };
    const VkImageSubresourceRange range =
        target_range(e->pass, r, target->resolve_mip, target->resolve_layer);
    if (r->image->samples > 1)
        fault(e, RG_ERROR_SAMPLES, r, "resolve to an image of one sample a texel");
    if (target->image->samples <= 1)
        fault(e, RG_ERROR_SAMPLES, r, "resolve from an image of several samples a texel");
    if (r->image->format != target->image->format)
        fault(e, RG_ERROR_FORMAT, r, "resolve to an image of the same format");
    check_extent(e, r, range.baseMipLevel);
    add_access(e, a, &range, NULL);
}

static void add_target(struct expansion *e, const struct rg_target *target)
{
    const struct rg_pass *rg = e->pass->rg;
    enum rg_access kind = target != &rg->depth  ? RG_COLOR
                          : rg->depth_read_only ? RG_DEPTH_READ
                                                : RG_DEPTH;
    const struct rg_access_info *info = &rg_access_table[kind];
    bool keeps = target->load == RG_LOAD_KEEP;
    bool reads = keeps || target->blend || kind != RG_COLOR;
    const struct effect effect = rg_effect(kind, reads, info->stages);
    const struct effect *kept = new_effect(e->c, &effect);
    struct resource *r = rg_resource_of(e->c, target->image, NULL);
    struct access *a = next_access(e->c);
    if (!r || !a || !kept)
        return;
    unsigned flags = rg->when ? ACCESS_CONDITIONAL : 0;
    if (keeps || kind == RG_DEPTH_READ)
        flags |= ACCESS_READS_CONTENT;
    if (info->writes_content)
        flags |= ACCESS_WRITES_CONTENT | (keeps || rg->when ? 0 : ACCESS_OVERWRITES);
    *a = (struct access){
        .resource = r,
        .effect = kept,
        .declared = target,
        .flags = flags,
    };
    e->c->color_access_count += kind == RG_COLOR;
    const VkImageSubresourceRange range = target_range(e->pass, r, target->mip, target->layer);
    check_target(e, target, r, range.baseMipLevel);
    add_access(e, a, &range, "clear it, or put the pass that fills it before this one");
    if (target->resolve && target != &rg->depth)
        add_resolve(e, target);
}

/* ---- uses ---- */

static const char unwritten_hint[] = "put the pass that writes it before this one, or import it";

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

/* Whether a use says nothing beyond its image, access, binding and sampler. */
static bool is_plain(const struct rg_use *use)
{
    const struct rg_range *range = &use->range;
    return !(range->aspect | range->mip | range->mip_count | range->layer | range->layer_count |
             range->each | use->stages | use->partial | (uintptr_t)use->buffer);
}

/* An access that begins as what it means by itself. */
static void refine_use(struct expansion *e, const struct rg_use *use, struct access *a)
{
    static const VkImageSubresourceRange none = { 0 };
    const struct resource *r = a->resource;
    const VkImageSubresourceRange range = r->image ? use_range(r, &use->range, e->pass) : none;
    if (use->stages && !rg_access_table[use->access].stages) {
        struct effect *effect = new_effect(e->c, a->effect);
        if (!effect)
            return;
        effect->stages = use->stages;
        if (!(a->flags & ACCESS_WRITES_CONTENT))
            effect->visibility = rg_visibility(use->access, use->stages);
        a->effect = effect;
    }
    if (use->partial || e->pass->rg->when)
        a->flags &= ~(uint32_t)ACCESS_OVERWRITES;
    if (e->pass->rg->when)
        a->flags |= ACCESS_CONDITIONAL;
    add_access(e, a, &range, unwritten_hint);
}

/* Returns false if rg_check_uses() has to look at it. */
__attribute__((noinline)) static bool add_use(struct expansion *e, const struct rg_use *use)
{
    struct compiler *c = e->c;
    if (!rg_is_good_use(use))
        return false;
    const struct meaning *m = rg_meaning(c, rg_kind_of(e->pass->rg), use->access);
    bool fine = rg_is_fine_use(use, m);
    if (rg_is_shader_access(use->access)) {
        fine = fine && use->binding >= e->next_binding;
        if (use->binding >= e->next_binding)
            e->next_binding = use->binding + 1u;
    }
    e->flags |= m->flags;
    struct resource *r = rg_resource_of(c, use->image, use->buffer);
    struct access *a = next_access(c);
    if (!r || !a)
        return fine;
    *a = (struct access){
        .resource = r,
        .effect = use->image ? &m->on_image : &m->on_buffer,
        .declared = use,
        .flags = m->flags,
    };
    refine_use(e, use, a);
    return fine;
}

/* What shaders of such a pass do to images by an access; NULL: nothing. */
__attribute__((noinline)) static const struct meaning *learn(struct compiler *c, enum rg_kind kind,
                                                             enum rg_access access)
{
    if ((unsigned)access >= RG_ACCESS_COUNT)
        return NULL;
    rg_meaning(c, kind, access);
    return c->of_shaders[kind][access];
}

/*
 * Adds uses while nothing can be wrong with them, which is nearly always: shaders read or write all
 * of an image of one cell, at rising bindings. Returns the first other one, or the end.
 */
__attribute__((always_inline)) static inline const struct rg_use *
add_plain_uses(struct expansion *e, enum rg_kind kind, const struct rg_use *use)
{
    struct compiler *c = e->c;
    const uint32_t first = e->pass->first_access;
    uint32_t count = c->access_count;
    uint32_t next_binding = e->next_binding;
    for (; use->image && count < c->access_room; use++) {
        const struct meaning *m =
            (unsigned)use->access < RG_ACCESS_COUNT ? c->of_shaders[kind][use->access] : NULL;
        if (!m && !(m = learn(c, kind, use->access)))
            break;
        if (use->binding < next_binding || !is_plain(use))
            break;
        struct resource **slot = rg_resource_slot(&c->map, use->image);
        struct resource *r = *slot ? *slot : rg_resource_add_plain(c, use->image, slot);
        if (!r)
            break;
        bool unfilled = m->flags & ACCESS_READS_CONTENT && r->cell.filled != CELL_FILLED;
        if (!r->plain || r->cell.last_access > first || unfilled)
            break;
        struct access *a = &c->accesses[count];
        a->resource = r;
        a->effect = &m->on_image;
        a->declared = use;
        a->range = 0;
        a->flags = m->flags;
        r->cell.last_access = ++count;
        if (m->flags & ACCESS_WRITES_CONTENT)
            r->cell.filled = CELL_FILLED;
        next_binding = use->binding + 1u;
        e->flags |= m->flags;
    }
    c->access_count = count;
    e->next_binding = next_binding;
    return use;
}

/* Returns false if rg_check_uses() has to look at them. */
__attribute__((noinline)) static bool add_uses(struct expansion *e, const struct rg_use *use)
{
    const struct rg_pass *rg = e->pass->rg;
    bool fine = true;
    for (; use; use++) {
        if (!rg->when)
            use = add_plain_uses(e, rg_kind_of(rg), use);
        if (!rg_is_use(use))
            break;
        fine = add_use(e, use) && fine;
    }
    return fine;
}

/* ---- rows ---- */

/* False: memory is short. */
static inline bool begin_pass(struct expansion *e, const struct rg_pass *rg, uint32_t repetition)
{
    struct compiler *c = e->c;
    if (!ARENA_ROOM(c->arena, c->passes, c->pass_count, c->pass_room, 64))
        return false;
    struct pass *pass = &c->passes[c->pass_count];
    pass->technique = e->place.technique;
    pass->row = e->place.row;
    pass->repetition = repetition;
    pass->rg = rg;
    pass->extent = c->params->view;
    pass->first_access = c->access_count;
    e->pass = pass;
    e->next_binding = 0;
    e->flags = 0;
    return true;
}

static inline void end_pass(struct expansion *e)
{
    struct compiler *c = e->c;
    e->pass->access_count = c->access_count - e->pass->first_access;
    c->pass_count++;
}

/* Of a row as most are: it computes, once in every frame. Returns false if rg_check_uses() has to
 * look at it. */
static inline bool add_simple_pass(struct expansion *e, const struct rg_pass *rg)
{
    if (!begin_pass(e, rg, 0))
        return false;
    const struct rg_use *use = add_plain_uses(e, RG_COMPUTE, rg->uses);
    bool fine = !rg_is_use(use) || add_uses(e, use);
    end_pass(e);
    return fine && (e->flags & ACCESS_WRITES_CONTENT);
}

/* The same of any row. */
static bool add_pass(struct expansion *e, const struct rg_pass *rg, uint32_t repetition)
{
    if (!begin_pass(e, rg, repetition))
        return false;
    e->target_samples = 0;
    uint32_t color_count = rg_color_count(rg);
    for (uint32_t i = 0; i < color_count; i++)
        add_target(e, &rg->color[i]);
    if (rg->depth.image)
        add_target(e, &rg->depth);
    e->flags = rg_draws(rg) ? ACCESS_WRITES_CONTENT : 0;
    bool fine = add_uses(e, rg->uses);
    end_pass(e);
    return fine && (e->flags & ACCESS_WRITES_CONTENT);
}

/* The layers or mips of a row's first image written, from the first one named; at least 1, so that
 * a first one that is not there becomes a fault of ranges. 0: there is no such image. */
static uint32_t repetition_count(struct compiler *c, const struct rg_pass *pass)
{
    const struct rg_target *target = rg_color_count(pass) ? pass->color : &pass->depth;
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
    const struct resource *r = image ? rg_resource_of(c, image, NULL) : NULL;
    if (!r)
        return 0;
    if (pass->repeat == RG_PER_LAYER)
        return r->all.layerCount > layer ? r->all.layerCount - layer : 1;
    return r->all.levelCount > mip ? r->all.levelCount - mip : 1;
}

/* The same. */
__attribute__((noinline)) static bool add_passes(struct expansion *e, const struct rg_pass *rg)
{
    uint32_t count = rg->repeat == RG_ONCE ? 1 : repetition_count(e->c, rg);
    bool fine = count;
    if (!count)
        rg_fault_add(e->c, RG_ERROR_REPEAT, e->place,
                     "a repeated row writes an image, whose layers or mips it counts");
    for (uint32_t i = 0; i < count && !e->c->arena->failed; i++)
        fine = add_pass(e, rg, i) && fine;
    return fine;
}

/* Faults of uses by themselves come before those of what they do together with others. */
static void expand_row(struct expansion *e, const struct rg_pass *rg)
{
    struct compiler *c = e->c;
    c->row_first_fault = c->fault_count;
    if (!rg->name)
        rg_fault_add(c, RG_ERROR_NO_NAME, e->place, "give the pass a name");
    else if (!rg_name_add_quickly(c, NAME_PASS, rg->name) &&
             !rg_name_is_new(c, NAME_PASS, rg->name))
        rg_fault_add(c, RG_ERROR_DUPLICATE_NAME, e->place, RG_HINT_NAME);
    bool simple = rg_is_simple_row(rg);
    if (!simple)
        rg_check_row(c, rg, &e->place);
    uint32_t first_fault = c->fault_count;
    if (simple ? add_simple_pass(e, rg) : add_passes(e, rg))
        return;
    uint32_t later_fault = c->fault_count;
    rg_check_uses(c, rg, &e->place);
    rg_fault_reorder(c, first_fault, later_fault);
}

static void expand_technique(struct compiler *c, const struct rg_technique *technique)
{
    struct expansion e = { .c = c, .place = { technique, RG_NONE, NULL } };
    if (!technique->name)
        rg_fault_add(c, RG_ERROR_NO_NAME, e.place, "give the technique a name");
    for (uint32_t p = 0; p < technique->pass_count && !c->arena->failed; p++) {
        e.place.row = p;
        expand_row(&e, &technique->passes[p]);
    }
}

void rg_expand(struct compiler *c)
{
    for (uint32_t t = 0; t < c->params->technique_count; t++)
        expand_technique(c, c->params->techniques[t]);
    c->row_first_fault = c->fault_count;
    for (uint32_t i = 0; i < c->end_count; i++) {
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
