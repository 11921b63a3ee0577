/* expand_passes.c: expands pass declarations to passes (one per repetition) and their accesses. */
#include "graph/compile/compiler.h"

/* ---- accesses ---- */

/* Lowest bit of each access in the mask cell.visible. Shader accesses use 3 bits, one per stage. */
static const uint32_t visibility_bits[RG_ACCESS_COUNT] = {
    [RG_SAMPLED] = 1 << 0,   [RG_STORAGE_READ] = 1 << 3, [RG_UNIFORM] = 1 << 6,
    [RG_COLOR] = 1 << 9,     [RG_DEPTH] = 1 << 10,       [RG_DEPTH_READ] = 1 << 10,
    [RG_VERTEX] = 1 << 11,   [RG_INDEX] = 1 << 12,       [RG_INDIRECT] = 1 << 13,
    [RG_COPY_SRC] = 1 << 14, [RG_HOST_READ] = 1 << 15,   [RG_TRACE] = 1 << 16,
};

static uint32_t visibility_of(enum rg_access kind, VkPipelineStageFlags2 stages)
{
    uint32_t bit = visibility_bits[kind];
    if (!rg_is_shader_access(kind))
        return bit;
    /* the vertex, fragment and compute shader's bits, 3, 7 and 11, become 0, 1 and 2 */
    uint32_t shaders = (uint32_t)((stages >> 3 & 1) | (stages >> 6 & 2) | (stages >> 9 & 4));
    return bit * shaders | (stages & ~RG_ANY_SHADER ? ~RG_VISIBLE_TO_ALL : 0);
}

/* Initialises `a` as an access of this kind to a whole resource, and returns `a`. */
static inline struct access *init_access(struct access *a, struct resource *r, enum rg_access kind,
                                         VkPipelineStageFlags2 stages)
{
    const struct rg_access_info *info = &rg_access_table[kind];
    a->resource = r;
    a->declared = NULL;
    a->cells = r->cells;
    a->cell_count = r->cell_count;
    a->range = r->all;
    a->kind = (uint8_t)kind;
    a->queue = RG_QUEUE_MAIN;
    a->flags = (uint8_t)(info->reads_content * ACCESS_READS | info->writes_content * ACCESS_WRITES);
    a->visibility = info->writes_content ? 0 : visibility_of(kind, stages);
    a->layout = r->image ? info->layout : VK_IMAGE_LAYOUT_UNDEFINED;
    a->stages = stages;
    a->mask = info->reads | info->writes;
    return a;
}

struct access rg_boundary_access(struct resource *r, enum rg_access kind)
{
    const struct rg_access_info *info = &rg_access_table[kind];
    bool shader = !info->stages && (info->reads || info->writes);
    struct access a;
    init_access(&a, r, kind, shader ? RG_ANY_SHADER : info->stages);
    a.flags |= ACCESS_READS;
    return a;
}

/* ---- subresources that an access reads and writes ---- */

static bool is_filled(const struct compiler *c, const struct cell *cell, rg_when_fn *when)
{
    return cell->filled == CELL_FILLED ||
           (cell->filled >= CELL_FILLED_BY &&
            c->plan_passes[cell->filled - CELL_FILLED_BY].pass->when == when);
}

static void report_conflict(struct compiler *c, const struct access *before, const struct access *a)
{
    char names[2][64];
    const struct access *both[] = { before, a };
    for (int i = 0; i < 2; i++) {
        const char *kind = rg_access_table[both[i]->kind].name;
        const struct rg_use *use = both[i]->declared;
        if (rg_is_shader_access(both[i]->kind))
            snprintf(names[i], sizeof(names[i]), "%s at binding %u", kind, use->binding);
        else
            snprintf(names[i], sizeof(names[i]), "%s", kind);
    }
    rg_fault_with(c, RG_ERROR_CONFLICT, a->resource->name,
                  "'%s' and '%s': split the pass in two, or read another mip, layer or image",
                  names[0], names[1]);
}

/* Initialises an access, to be added by keep_access(). Returns NULL if out of memory. */
RG_INLINE struct access *next_access(struct compiler *c, struct resource *r, enum rg_access kind,
                                     VkPipelineStageFlags2 stages)
{
    if (!r || !ARENA_ROOM(c->arena, c->accesses, c->access_count, c->access_room, c->row_count * 8))
        return NULL;
    return init_access(&c->accesses[c->access_count], r, kind, stages);
}

/* Sets an access's range and its cells. Reports a fault and returns false for an invalid range. */
static bool set_range(struct compiler *c, struct access *a, const VkImageSubresourceRange *range)
{
    const struct range *all = &a->resource->all;
    const uint32_t aspects = range->aspectMask;
    const bool fits = aspects && !(aspects & ~(uint32_t)all->aspects) && range->levelCount &&
                      range->layerCount && range->baseMipLevel < all->mip_count &&
                      range->levelCount <= all->mip_count - range->baseMipLevel &&
                      range->baseArrayLayer < all->layer_count &&
                      range->layerCount <= all->layer_count - range->baseArrayLayer;
    rg_fault_if(c, !fits, RG_ERROR_RANGE, a->resource->name,
                "name a mip, layer and aspect that the image has");
    if (!fits)
        return false;
    a->range = (struct range){ (uint16_t)range->baseArrayLayer, (uint16_t)range->layerCount,
                               (uint8_t)range->baseMipLevel, (uint8_t)range->levelCount,
                               (uint8_t)aspects };
    a->cells = rg_find_cell(a->resource, aspects, range->baseMipLevel, range->baseArrayLayer);
    a->cell_count = (aspects & (aspects - 1) ? 2 : 1) * range->levelCount * range->layerCount;
    return true;
}

/* Adds a prepared access to the pass. If the pass is conditional, earlier content is kept. */
RG_INLINE void keep_access(struct compiler *c, struct access *a, const char *unfilled_hint)
{
    const char *name = a->resource->name;
    VkImageAspectFlags aspects = a->range.aspects;
    rg_when_fn *when = c->pass->pass->when;
    uint32_t first = c->passes[c->pass_count].first_access;
    uint32_t filled_now = when ? CELL_FILLED_BY + c->pass_count : CELL_FILLED;
    const struct access *conflict = NULL;
    bool all_filled = true;
    a->queue = (uint8_t)c->passes[c->pass_count].queue;
    if (when)
        a->flags = (a->flags & (uint8_t)~ACCESS_OVERWRITES) | ACCESS_CONDITIONAL;
    rg_fault_if(c, (aspects & (aspects - 1)) && rg_is_shader_access(a->kind), RG_ERROR_RANGE, name,
                "range: expected depth or stencil, since a shader reads only one aspect");
    for (struct cell_walk w = rg_cells(a); w.cell; rg_next_cell(&w)) {
        bool filled = is_filled(c, w.cell, when);
        all_filled = all_filled && filled;
        if (!conflict && w.cell->last_access > first) { /* accessed by this pass before */
            const struct access *before = &c->accesses[w.cell->last_access - 1];
            if ((a->flags | before->flags) & ACCESS_WRITES || a->layout != before->layout)
                conflict = before;
        }
        if (a->flags & ACCESS_WRITES && !(when && filled))
            w.cell->filled = filled_now;
        w.cell->last_access = c->access_count + 1;
    }
    if (conflict)
        report_conflict(c, conflict, a);
    rg_fault_if(c, a->flags & ACCESS_WRITES && rg_is_history(a->resource), RG_ERROR_ACCESS, name,
                "write its `previous`: a history is read-only");
    rg_fault_if(c, !all_filled && a->flags & ACCESS_READS, RG_ERROR_READ_BEFORE_WRITE, name,
                unfilled_hint);
    c->access_count++;
}

static void check_extent(struct compiler *c, const struct resource *r, uint32_t mip)
{
    VkExtent2D *pass = &c->pass->extent;
    VkExtent2D extent = r->extent;
    if (mip)
        extent = (VkExtent2D){ rg_mip_side(extent.width, mip), rg_mip_side(extent.height, mip) };
    if (c->access_count == c->passes[c->pass_count].first_access && !c->target_samples)
        *pass = extent;
    rg_fault_if(c, extent.width != pass->width || extent.height != pass->height,
                RG_ERROR_TARGET_SIZE, r->name, "all targets of a pass must have the same size");
}

static void check_target(struct compiler *c, const struct rg_target *target,
                         const struct resource *r, uint32_t mip)
{
    const struct rg_pass *row = c->pass->pass;
    bool is_depth = target == &row->depth;
    bool has_depth = !(r->all.aspects & VK_IMAGE_ASPECT_COLOR_BIT);
    uint32_t samples = r->image->samples ? r->image->samples : 1;
    if (mip < r->all.mip_count)
        check_extent(c, r, mip);
    rg_fault_if(c, is_depth && !has_depth, RG_ERROR_FORMAT, r->name,
                "a depth target needs a depth format");
    rg_fault_if(c, !is_depth && has_depth, RG_ERROR_FORMAT, r->name,
                "a colour target needs a colour format");
    rg_fault_if(c, is_depth && row->depth_read_only && target->load != RG_LOAD_KEEP,
                RG_ERROR_ACCESS, r->name, "a read-only depth target must be RG_LOAD_KEEP");
    rg_fault_if(c, is_depth && row->stencil && !(r->all.aspects & VK_IMAGE_ASPECT_STENCIL_BIT),
                RG_ERROR_FORMAT, r->name, "a stencil test needs a format with a stencil");
    rg_fault_if(c, r->image->depth, RG_ERROR_ACCESS, r->name,
                "a 3D image cannot be a target: write it as a storage image");
    rg_fault_if(c, is_depth && target->resolve, RG_ERROR_SAMPLES, r->name,
                "only colour can be resolved; read depth by texelFetch");
    rg_fault_if(c, c->target_samples && samples != c->target_samples, RG_ERROR_SAMPLES, r->name,
                "all targets of a pass must have the same number of samples");
    c->target_samples = samples;
}

static VkImageSubresourceRange target_range(const struct compiler *c, const struct resource *r,
                                            uint32_t mip, uint32_t layer)
{
    if (c->pass->pass->repeat == RG_PER_LAYER && r->all.layer_count > 1)
        layer += c->step;
    if (c->pass->pass->repeat >= RG_PER_MIP && r->all.mip_count > 1)
        mip += c->step;
    const uint32_t layers = c->pass->pass->layers;
    return (VkImageSubresourceRange){ r->all.aspects, mip, 1, layer, layers ? layers : 1 };
}

static void add_resolve(struct compiler *c, const struct rg_target *target)
{
    struct resource *r = rg_resource_of(c, target->resolve, NULL);
    struct access *a = next_access(c, r, RG_RESOLVE, rg_access_table[RG_RESOLVE].stages);
    if (!a)
        return;
    a->declared = target;
    const VkImageSubresourceRange range =
        target_range(c, r, target->resolve_mip, target->resolve_layer);
    a->flags |= ACCESS_OVERWRITES;
    rg_fault_if(c, r->image->samples > 1 || r->image->depth, RG_ERROR_SAMPLES, r->name,
                "resolve to a 2D image with one sample per texel");
    rg_fault_if(c, target->image->samples <= 1, RG_ERROR_SAMPLES, r->name,
                "resolve from a multisampled image");
    rg_fault_if(c, r->image->format != target->image->format, RG_ERROR_FORMAT, r->name,
                "resolve to an image of the same format");
    check_extent(c, r, range.baseMipLevel);
    if (set_range(c, a, &range))
        keep_access(c, a, NULL);
}

static void add_target(struct compiler *c, const struct rg_target *target)
{
    const struct rg_pass *row = c->pass->pass;
    enum rg_access kind = target != &row->depth  ? RG_COLOR
                          : row->depth_read_only ? RG_DEPTH_READ
                                                 : RG_DEPTH;
    bool keeps = target->load == RG_LOAD_KEEP;
    struct resource *r = rg_resource_of(c, target->image, NULL);
    struct access *a = next_access(c, r, kind, rg_access_table[kind].stages);
    if (!a)
        return;
    a->declared = target;
    const VkImageSubresourceRange range = target_range(c, r, target->mip, target->layer);
    if (keeps)
        a->flags |= ACCESS_READS;
    else if (a->flags & ACCESS_WRITES)
        a->flags |= ACCESS_OVERWRITES;
    if (kind == RG_COLOR && !keeps && !rg_keeps_color(target))
        a->mask = rg_access_table[kind].writes;
    check_target(c, target, r, range.baseMipLevel);
    if (set_range(c, a, &range))
        keep_access(c, a, "clear it, or move the pass that writes it before this one");
    if (target->resolve && kind == RG_COLOR)
        add_resolve(c, target);
}

static VkImageSubresourceRange use_range(const struct compiler *c, const struct resource *r,
                                         const struct rg_range *range)
{
    const enum rg_repeat repeat = c->pass->pass->repeat;
    VkImageSubresourceRange out = {
        .aspectMask = range->aspect ? range->aspect : r->all.aspects,
        .baseMipLevel = range->mip,
        .levelCount = range->mip_count,
        .baseArrayLayer = range->layer,
        .layerCount = range->layer_count,
    };
    if (range->each && repeat == RG_PER_LAYER) {
        out.baseArrayLayer += c->step;
        out.layerCount = 1;
    } else if (range->each && repeat != RG_ONCE) {
        out.baseMipLevel += c->step;
        out.levelCount = 1;
    }
    if (!out.levelCount && out.baseMipLevel < r->all.mip_count)
        out.levelCount = r->all.mip_count - out.baseMipLevel;
    if (!out.layerCount && out.baseArrayLayer < r->all.layer_count)
        out.layerCount = r->all.layer_count - out.baseArrayLayer;
    return out;
}

static void add_use(struct compiler *c, const struct rg_pass *row, const struct rg_use *use)
{
    struct resource *r = rg_resource_of(c, use->image, use->buffer);
    VkPipelineStageFlags2 stages = rg_use_stages(row, use);
    struct access *a = next_access(c, r, use->access, stages);
    if (!a)
        return;
    a->declared = use;
    if (use->view_format && use->image && use->view_format != use->image->format)
        r->is_mutable = true;
    /* a depth image that is tested and sampled: read-only depth layout for the whole range */
    if (row->depth_read_only && use->access == RG_SAMPLED && use->image &&
        use->image == row->depth.image)
        a->layout = rg_access_table[RG_DEPTH_READ].layout;
    if (use->texels || (use->buffer && use->access == RG_SAMPLED))
        a->flags |= ACCESS_TEXELS;
    if ((a->flags & ACCESS_WRITES) && !(a->flags & ACCESS_READS) && !use->partial)
        a->flags |= ACCESS_OVERWRITES;
    const struct rg_range *g = &use->range;
    if (use->image &&
        (g->aspect || g->mip || g->mip_count || g->layer || g->layer_count || g->each)) {
        const VkImageSubresourceRange range = use_range(c, r, &use->range);
        if (!set_range(c, a, &range))
            return;
    }
    keep_access(c, a, "move the pass that writes it before this one, or import it");
}

/* ---- placeholder images ---- */

static void provide(struct compiler *c, const struct rg_image *image)
{
    void **value = image ? rg_map_value(c->arena, &c->provided, image) : NULL;
    if (value)
        *value = &c->provided;
}

static void provide_row(struct compiler *c, const struct rg_pass *pass)
{
    uint32_t color_count = rg_color_count(pass);
    for (uint32_t i = 0; i < color_count; i++) {
        provide(c, pass->color[i].image);
        provide(c, pass->color[i].resolve);
    }
    if (!pass->depth_read_only)
        provide(c, pass->depth.image);
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use); use++) {
        if (rg_is_valid_use(use) && rg_access_table[use->access].writes_content)
            provide(c, use->image);
    }
}

static void find_provided(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    rg_map_reserve(c->arena, &c->provided, c->row_count);
    for (size_t i = 0; i < params->import_count; i++)
        provide(c, params->imports[i].image);
    for (size_t t = 0; t < params->technique_count; t++) {
        for (size_t p = 0; p < params->techniques[t]->pass_count; p++)
            provide_row(c, &params->techniques[t]->passes[p]);
    }
}

/* Returns true and binds a fallback if no pass or import provides the image. */
static bool use_fallback(struct compiler *c, const struct rg_use *use)
{
    if (use->access != RG_SAMPLED || !use->image)
        return false;
    if (!c->provided.slots)
        find_provided(c);
    void **value = rg_map_value(c->arena, &c->provided, use->image);
    if (value && !*value && use->image->previous)
        value = rg_map_value(c->arena, &c->provided, use->image->previous);
    if (!value || *value ||
        !ARENA_ROOM(c->arena, c->fallbacks, c->fallback_count, c->fallback_room, 16))
        return false;
    c->fallbacks[c->fallback_count++] = use;
    return true;
}

/* ---- rows ---- */

static void add_pass(struct compiler *c, const struct rg_pass *row, uint32_t repetition)
{
    uint32_t color_count = rg_color_count(row);
    if (!ARENA_ROOM(c->arena, c->passes, c->pass_count, c->pass_room, c->row_count * 2) ||
        !ARENA_ROOM(c->arena, c->plan_passes, c->pass_count, c->plan_pass_room, c->row_count * 2))
        return;
    struct pass *pass = &c->passes[c->pass_count];
    struct rg_plan_pass *out = c->pass = &c->plan_passes[c->pass_count];
    pass->first_access = c->access_count;
    pass->queue = RG_QUEUE_MAIN;
    if ((unsigned)row->queue < RG_QUEUE_COUNT && c->params->queues >> row->queue & 1)
        pass->queue = row->queue;
    out->pass = row;
    out->technique = c->technique;
    out->row = c->row;
    out->repetition = repetition;
    out->extent = c->params->view;
    out->first_fallback = c->fallback_count;
    c->color_count += color_count;
    c->target_samples = 0;
    for (uint32_t i = 0; i < color_count; i++)
        add_target(c, &row->color[i]);
    if (row->depth.image)
        add_target(c, &row->depth);
    for (const struct rg_use *use = row->uses; use && rg_is_use(use); use++) {
        if (rg_is_valid_use(use) && !(use->fallback && use_fallback(c, use)))
            add_use(c, row, use);
    }
    pass->access_count = c->access_count - pass->first_access;
    out->fallback_count = c->fallback_count - out->first_fallback;
    c->pass_count++;
}

/* Returns how often a pass runs; 0 if a repeated pass writes no image. A repeated pass runs for
 * each mip level or layer of its first written image, from the declared one on, at least once. */
static uint32_t repetition_count(struct compiler *c, const struct rg_pass *pass)
{
    if (pass->repeat == RG_ONCE)
        return 1;
    const struct rg_target *target = rg_color_count(pass) ? pass->color : &pass->depth;
    const struct rg_image *image = target->image;
    uint32_t mip = target->mip;
    uint32_t layer = target->layer;
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use) && !image; use++) {
        if (rg_is_valid_use(use) && rg_access_table[use->access].writes_content) {
            image = use->image;
            mip = use->range.mip;
            layer = use->range.layer;
        }
    }
    const struct resource *r = image ? rg_resource_of(c, image, NULL) : NULL;
    if (!r)
        return 0;
    if (pass->repeat == RG_PER_LAYER)
        return r->all.layer_count > layer ? r->all.layer_count - layer : 1;
    uint32_t count = r->all.mip_count > mip ? r->all.mip_count - mip : 1;
    for (const struct rg_use *use = pass->uses;
         pass->repeat == RG_PER_MIP_UP && use && rg_is_use(use); use++) {
        if (!rg_is_valid_use(use) || !use->image || !use->range.each || use->fallback)
            continue;
        r = rg_resource_of(c, use->image, NULL);
        if (r && r->all.mip_count > use->range.mip && r->all.mip_count - use->range.mip < count)
            count = r->all.mip_count - use->range.mip;
    }
    return count;
}

static void expand_row(struct compiler *c, const struct rg_pass *row)
{
    c->row_first_fault = c->fault_count;
    rg_fault_if(c, !row->name, RG_ERROR_NO_NAME, NULL, "give the pass a name");
    rg_fault_if(c, row->name && rg_map_add_text(c->arena, &c->pass_names, row->name),
                RG_ERROR_DUPLICATE_NAME, NULL, "give each pass a unique name");
    rg_check_row(c, row);
    if (c->fault_count == c->row_first_fault)
        rg_check_shaders(c, row);
    uint32_t count = repetition_count(c, row);
    rg_fault_if(c, !count, RG_ERROR_REPEAT, NULL,
                "a repeated row must write an image, whose layers or mips define the repetitions");
    for (uint32_t i = 0; i < count && !c->arena->failed; i++) {
        c->step = row->repeat == RG_PER_MIP_UP ? count - 1 - i : i;
        add_pass(c, row, i);
    }
}

/* Checks that a resource whose content is needed after the frame is written completely. */
static void check_filled(struct compiler *c, const struct resource *r)
{
    bool complete = true;
    for (uint32_t k = 0; k < r->cell_count; k++)
        complete = complete && r->cells[k].filled == CELL_FILLED;
    if (!complete)
        rg_fault_of(c, RG_ERROR_OUTPUT_NOT_WRITTEN, r->name,
                    "list a technique whose passes write all of it in every frame");
}

void rg_expand(struct compiler *c)
{
    for (uint32_t t = 0; t < c->params->technique_count; t++) {
        c->technique = c->params->techniques[t];
        c->row = RG_NONE;
        rg_fault_if(c, !c->technique->name, RG_ERROR_NO_NAME, NULL, "give the technique a name");
        for (c->row = 0; c->row < c->technique->pass_count && !c->arena->failed; c->row++)
            expand_row(c, &c->technique->passes[c->row]);
    }
    c->technique = NULL;
    c->row = RG_NONE;
    c->row_first_fault = c->fault_count;
    const uint32_t count = c->persistent_count ? c->resource_count : c->boundary_count;
    for (uint32_t i = 0; i < count; i++) {
        if (c->resources[i]->output != RG_NONE || c->resources[i]->partner)
            check_filled(c, c->resources[i]);
    }
}
