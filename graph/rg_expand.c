/* rg_expand.c: rows become passes (one for each repetition), uses and targets become accesses. */
#include "graph/rg_internal.h"

static const VkPipelineStageFlags2 shader_stages[] = {
    [RG_RASTER] = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    [RG_COMPUTE] = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    [RG_TRANSFER] = VK_PIPELINE_STAGE_2_NONE,
};

/* The layers or mips of a row's first image written, from the first one named; at least 1, so that
 * a first one that is not there becomes a fault of ranges. 0: there is no such image. */
static uint32_t repetition_count(const struct compiler *c, const struct rg_pass *pass)
{
    const struct rg_target *target = pass->color[0].image ? &pass->color[0] : &pass->depth;
    const struct rg_image *image = target->image;
    uint32_t mip = target->mip;
    uint32_t layer = target->layer;
    for (const struct rg_use *use = pass->uses; use && rg_is_use(use) && !image; use++) {
        if (rg_is_good_use(use) && rg_access_info(use->access)->writes_content) {
            image = use->image;
            mip = use->range.mip;
            layer = use->range.layer;
        }
    }
    if (!image)
        return 0;
    const struct resource *r = &c->resources[rg_find(c, image)];
    if (pass->repeat == RG_PER_LAYER)
        return r->layers > layer ? r->layers - layer : 1;
    return r->mips > mip ? r->mips - mip : 1;
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
static void add_access(struct compiler *c, struct pass *pass, const struct access *access)
{
    const struct resource *r = &c->resources[access->resource];
    if (r->image && !in_range(r, &access->range)) {
        const struct place place = { rg_technique_of(c, pass), pass->row, r->name };
        rg_fault_add(c, RG_ERROR_RANGE, place, "name a mip, layer and aspect that the image has");
        return;
    }
    VkImageAspectFlags aspects = access->range.aspectMask;
    bool descriptor = access->use && rg_access_info(access->access)->image_descriptor !=
                                         VK_DESCRIPTOR_TYPE_MAX_ENUM;
    if (descriptor && (aspects & (aspects - 1))) {
        const struct place place = { rg_technique_of(c, pass), pass->row, r->name };
        rg_fault_add(c, RG_ERROR_RANGE, place, "a shader sees one aspect: name depth or stencil");
    }
    c->accesses[c->access_count++] = *access;
    pass->access_count++;
}

static void add_target(struct compiler *c, struct pass *pass, const struct rg_target *target)
{
    const struct rg_pass *rg = pass->rg;
    enum rg_access kind = target != &rg->depth  ? RG_COLOR
                          : rg->depth_read_only ? RG_DEPTH_READ
                                                : RG_DEPTH;
    const struct rg_access_info *info = rg_access_info(kind);
    uint32_t resource = rg_find(c, target->image);
    const struct resource *r = &c->resources[resource];
    uint32_t mip = target->mip;
    uint32_t layer = target->layer;
    if (rg->repeat == RG_PER_LAYER && r->layers > 1)
        layer += pass->repetition;
    if (rg->repeat == RG_PER_MIP && r->mips > 1)
        mip += pass->repetition;

    bool keeps = target->load == RG_LOAD_KEEP;
    bool reads = keeps || target->blend || kind != RG_COLOR;
    const struct access access = {
        .resource = resource,
        .access = kind,
        .range = { r->aspects, mip, 1, layer, 1 },
        .stages = info->stages,
        .reads = reads ? info->reads : VK_ACCESS_2_NONE,
        .writes = info->writes,
        .layout = info->layout,
        .reads_content = keeps || kind == RG_DEPTH_READ,
        .writes_content = info->writes_content,
        .overwrites = info->writes_content && !keeps,
        .target = target,
    };
    if (mip < r->mips && pass->access_count == 0)
        pass->extent = (VkExtent2D){
            r->extent.width >> mip ? r->extent.width >> mip : 1,
            r->extent.height >> mip ? r->extent.height >> mip : 1,
        };
    add_access(c, pass, &access);
}

static VkImageSubresourceRange resolve_range(const struct resource *r, const struct rg_range *range,
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

static void add_use(struct compiler *c, struct pass *pass, const struct rg_use *use)
{
    const struct rg_access_info *info = rg_access_info(use->access);
    uint32_t resource = rg_find(c, use->image ? (const void *)use->image : use->buffer);
    const struct resource *r = &c->resources[resource];
    VkPipelineStageFlags2 stages = info->stages ? info->stages : use->stages;
    if (!stages)
        stages = shader_stages[pass->rg->kind];
    if (!use->stages && use->access == RG_UNIFORM && pass->rg->kind == RG_RASTER)
        stages |= VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
    const struct access access = {
        .resource = resource,
        .access = use->access,
        .range = r->image ? resolve_range(r, &use->range, pass) : (VkImageSubresourceRange){ 0 },
        .stages = stages,
        .reads = info->reads,
        .writes = info->writes,
        .layout = r->image ? info->layout : VK_IMAGE_LAYOUT_UNDEFINED,
        .reads_content = info->reads_content,
        .writes_content = info->writes_content,
        .overwrites = info->writes_content && !info->reads_content && !use->partial,
        .use = use,
    };
    add_access(c, pass, &access);
}

/* `last_access` has, for every cell, one more than the index of its latest access. */
static void check_conflicts(struct compiler *c, const struct pass *pass, uint32_t *last_access)
{
    for (uint32_t i = pass->first_access; i < c->access_count; i++) {
        const struct access *a = &c->accesses[i];
        bool conflict = false;
        for (struct cell_walk w = rg_walk(c, a); rg_walk_next(&w);) {
            uint32_t last = last_access[w.cell];
            last_access[w.cell] = i + 1;
            if (last <= pass->first_access)
                continue;
            const struct access *b = &c->accesses[last - 1];
            conflict = conflict || a->writes_content || b->writes_content || a->layout != b->layout;
        }
        const struct place place = { rg_technique_of(c, pass), pass->row,
                                     c->resources[a->resource].name };
        if (conflict)
            rg_fault_add(c, RG_ERROR_CONFLICT, place,
                         "split the pass in two, or read another mip, layer or image");
    }
}

static void add_pass(struct compiler *c, struct pass *pass, uint32_t *last_access)
{
    const struct rg_pass *rg = pass->rg;
    pass->first_access = c->access_count;
    pass->extent = c->params->view;
    for (size_t i = 0; i < RG_COLOR_COUNT && rg->color[i].image; i++)
        add_target(c, pass, &rg->color[i]);
    if (rg->depth.image)
        add_target(c, pass, &rg->depth);
    for (const struct rg_use *use = rg->uses; use && rg_is_use(use); use++) {
        if (rg_is_good_use(use))
            add_use(c, pass, use);
    }
    check_conflicts(c, pass, last_access);
    c->passes[c->pass_count++] = *pass;
}

static uint32_t row_repetitions(struct compiler *c, const struct rg_technique *technique,
                                uint32_t row, bool report)
{
    const struct rg_pass *pass = &technique->passes[row];
    if (pass->repeat == RG_ONCE)
        return 1;
    uint32_t count = repetition_count(c, pass);
    if (!count && report)
        rg_fault_add(c, RG_ERROR_REPEAT, (struct place){ technique, row, NULL },
                     "a repeated row writes an image, whose layers or mips it counts");
    return count;
}

void rg_expand(struct compiler *c)
{
    const struct rg_compile_params *params = c->params;
    size_t pass_count = 0;
    size_t access_count = 0;
    for (size_t t = 0; t < params->technique_count; t++) {
        const struct rg_technique *technique = params->techniques[t];
        for (uint32_t p = 0; p < technique->pass_count; p++) {
            size_t repetitions = row_repetitions(c, technique, p, true);
            pass_count += repetitions;
            access_count +=
                repetitions * (RG_COLOR_COUNT + 1 + rg_use_count(&technique->passes[p]));
        }
    }
    c->passes = ARENA_ARRAY(&c->scratch, struct pass, pass_count);
    c->accesses = ARENA_ARRAY(&c->scratch, struct access, access_count);
    uint32_t *last_access = ARENA_ARRAY(&c->scratch, uint32_t, c->cell_count);
    if (c->scratch.failed)
        return;
    for (uint32_t t = 0; t < params->technique_count; t++) {
        const struct rg_technique *technique = params->techniques[t];
        for (uint32_t p = 0; p < technique->pass_count; p++) {
            uint32_t repetitions = row_repetitions(c, technique, p, false);
            for (uint32_t i = 0; i < repetitions; i++)
                add_pass(c,
                         &(struct pass){
                             .technique = t,
                             .row = p,
                             .repetition = i,
                             .rg = &technique->passes[p],
                         },
                         last_access);
        }
    }
}
