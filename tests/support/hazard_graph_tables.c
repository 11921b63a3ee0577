/* hazard_graph_tables.c: lists the accesses of all declared passes and their repetitions. */
#include "tests/support/hazard_private.h"

#include <math.h>
#include <stdlib.h>

/* Returns an image size: `given` or else `declared` if not 0, otherwise the scaled view size. */
static uint32_t texels(uint32_t given, uint32_t declared, float scale, uint32_t view)
{
    if (given || declared)
        return given ? given : declared;
    double scaled = ceil((double)view * (scale > 0.0F ? (double)scale : 1.0));
    return scaled < 1.0 ? 1 : (uint32_t)scaled;
}

/* Fills an image's properties. Those of an import take precedence over rg_compile_params.sizes, and
 * these over the declared ones. */
static void fill_image(const struct hazard *h, struct hazard_resource *resource)
{
    const struct rg_image *image = resource->image;
    const struct rg_import *import = resource->import;
    VkExtent2D view = h->params->view;
    VkExtent2D coming = { 0 };
    for (size_t i = 0; i < h->params->size_count; i++)
        if (h->params->sizes[i].image == image)
            coming = h->params->sizes[i].extent;
    if (import && import->extent.width && import->extent.height)
        coming = import->extent;
    resource->extent.width = texels(coming.width, image->width, image->scale, view.width);
    resource->extent.height = texels(coming.height, image->height, image->scale, view.height);
    resource->layers = image->layers ? image->layers : (image->cube ? 6 : 1);
    if (import && import->layers)
        resource->layers = import->layers;
    resource->depth = image->depth ? image->depth : 1;
    if (image->depth && import && import->depth)
        resource->depth = import->depth;
    resource->mips = image->mips ? image->mips : 1;
    if (import && import->mips) {
        resource->mips = import->mips;
    } else if (image->mips == RG_ALL_MIPS) {
        uint32_t size = resource->extent.width > resource->extent.height ? resource->extent.width
                                                                         : resource->extent.height;
        size = size > resource->depth ? size : resource->depth;
        for (resource->mips = 1; size > 1; size /= 2)
            resource->mips++;
    }
    resource->samples = image->samples ? image->samples : 1;
    resource->persistent = image->persistent && !import;
    resource->aspects = hazard_aspects(image->format);
}

static void fill_buffer(const struct hazard *h, struct hazard_resource *resource)
{
    const struct rg_buffer *buffer = resource->buffer;
    const VkExtent2D view = h->params->view;
    resource->size = buffer->size + buffer->size_per_texel * view.width * view.height;
    for (size_t i = 0; i < h->params->size_count; i++)
        if (h->params->sizes[i].buffer == buffer)
            resource->size = h->params->sizes[i].size;
    if (resource->import && resource->import->size)
        resource->size = resource->import->size;
    resource->persistent = buffer->persistent && !resource->import;
}

static void find_in_plan(const struct hazard *h, struct hazard_resource *resource)
{
    resource->plan = RG_NONE;
    for (uint32_t i = 0; resource->image && i < h->plan->image_count; i++)
        if (h->plan->images[i].image == resource->image)
            resource->plan = i;
    for (uint32_t i = 0; resource->buffer && i < h->plan->buffer_count; i++)
        if (h->plan->buffers[i].buffer == resource->buffer)
            resource->plan = i;
    const struct rg_compile_params *params = h->params;
    for (size_t i = 0; i < params->import_count; i++)
        if (params->imports[i].image == resource->image &&
            params->imports[i].buffer == resource->buffer)
            resource->import = &params->imports[i];
    for (size_t i = 0; i < params->output_count; i++)
        if (params->outputs[i].image == resource->image &&
            params->outputs[i].buffer == resource->buffer)
            resource->output = &params->outputs[i];
}

static uint32_t add_resource(struct hazard *h, const struct rg_image *image,
                             const struct rg_buffer *buffer)
{
    for (uint32_t i = 0; i < h->resource_count; i++)
        if (h->resources[i].image == image && h->resources[i].buffer == buffer)
            return i;
    h->resources = hazard_grow(h->resources, &h->resource_capacity, h->resource_count + 1,
                               sizeof(*h->resources));
    struct hazard_resource *resource = &h->resources[h->resource_count];
    *resource = (struct hazard_resource){
        .image = image,
        .buffer = buffer,
        .mips = 1,
        .layers = 1,
        .first = RG_NONE,
        .partner = RG_NONE,
    };
    find_in_plan(h, resource);
    uint32_t aspect_count = 1;
    if (image) {
        fill_image(h, resource);
        aspect_count = resource->aspects & (resource->aspects - 1) ? 2 : 1;
    } else {
        fill_buffer(h, resource);
    }
    resource->first_cell = h->cell_count;
    resource->cell_count = resource->mips * resource->layers * aspect_count;
    h->cell_count += resource->cell_count;
    h->cells = hazard_grow(h->cells, &h->cell_capacity, h->cell_count, sizeof(*h->cells));
    for (uint32_t i = resource->first_cell; i < h->cell_count; i++)
        h->cells[i] = (struct hazard_subresource){
            .resource = h->resource_count,
            .reads = RG_NONE,
            .barriers = RG_NONE,
            .last_barrier = RG_NONE,
        };
    return h->resource_count++;
}

static VkImageSubresourceRange resolve(const struct hazard_resource *resource,
                                       const struct rg_range *range, enum rg_repeat repeat,
                                       uint32_t step)
{
    VkImageSubresourceRange r = {
        .aspectMask = range->aspect ? range->aspect : resource->aspects,
        .baseMipLevel = range->mip,
        .levelCount = range->mip_count ? range->mip_count : resource->mips - range->mip,
        .baseArrayLayer = range->layer,
        .layerCount = range->layer_count ? range->layer_count : resource->layers - range->layer,
    };
    if (range->each && repeat == RG_PER_LAYER) {
        r.baseArrayLayer += step;
        r.layerCount = 1;
    }
    if (range->each && (repeat == RG_PER_MIP || repeat == RG_PER_MIP_UP)) {
        r.baseMipLevel += step;
        r.levelCount = 1;
    }
    return r;
}

static bool writes(enum rg_access access)
{
    return hazard_rule(access)->writes != 0;
}

/* Returns the number of repetitions of a pass: one for each layer or mip of its first target or
 * written image, from the declared layer or mip on. */
static uint32_t repetitions(struct hazard *h, const struct rg_pass *pass)
{
    if (pass->repeat == RG_ONCE)
        return 1;
    const struct rg_target *target =
        pass->color_count && pass->color[0].image ? &pass->color[0] : &pass->depth;
    const struct rg_image *image = target->image;
    struct rg_range range = { .mip = target->mip, .layer = target->layer };
    for (const struct rg_use *use = pass->uses; !image && use && use->access; use++)
        if (use->image && writes(use->access)) {
            image = use->image;
            range = use->range;
        }
    if (!image)
        return 1;
    uint32_t index = add_resource(h, image, NULL);
    const struct hazard_resource *resource = &h->resources[index];
    if (pass->repeat == RG_PER_LAYER)
        return resource->layers - range.layer;
    uint32_t count = resource->mips - range.mip;
    for (const struct rg_use *use = pass->uses; use && use->access; use++) {
        if (pass->repeat != RG_PER_MIP_UP || !use->image || !use->range.each)
            continue;
        const uint32_t other = add_resource(h, use->image, NULL);
        const uint32_t left = h->resources[other].mips - use->range.mip;
        count = left < count ? left : count;
    }
    return count;
}

static struct hazard_use *add_use(struct hazard *h, struct hazard_pass *pass,
                                  const struct rg_image *image, const struct rg_buffer *buffer,
                                  enum rg_access access)
{
    uint32_t resource = add_resource(h, image, buffer);
    const struct hazard_rule *rule = hazard_rule(access);
    h->uses = hazard_grow(h->uses, &h->use_capacity, h->use_count + 1, sizeof(*h->uses));
    pass->use_count++;
    h->uses[h->use_count] = (struct hazard_use){
        .resource = resource,
        .access = access,
        .stages = rule->stages,
        .reads = rule->reads,
        .writes = rule->writes,
        .needs_content = rule->reads != 0,
        .gives_content = rule->writes != 0,
    };
    return &h->uses[h->use_count++];
}

static struct hazard_use *add_attachment(struct hazard *h, struct hazard_pass *pass,
                                         const struct rg_target *target, enum rg_access access)
{
    bool resolve = access == RG_RESOLVE;
    const struct rg_image *image = resolve ? target->resolve : target->image;
    struct hazard_use *use = add_use(h, pass, image, NULL, access);
    use->target = target;
    use->resolve = resolve;
    use->range = (VkImageSubresourceRange){
        .aspectMask = h->resources[use->resource].aspects,
        .baseMipLevel = resolve ? target->resolve_mip : target->mip,
        .levelCount = 1,
        .baseArrayLayer = resolve ? target->resolve_layer : target->layer,
        .layerCount = pass->pass->layers ? pass->pass->layers : 1,
    };
    if (pass->pass->repeat == RG_PER_LAYER && h->resources[use->resource].layers > 1)
        use->range.baseArrayLayer += pass->step;
    if ((pass->pass->repeat == RG_PER_MIP || pass->pass->repeat == RG_PER_MIP_UP) &&
        h->resources[use->resource].mips > 1)
        use->range.baseMipLevel += pass->step;
    return use;
}

/* Adds a colour or depth target, and its resolve attachment as a separate write. */
static void add_target(struct hazard *h, struct hazard_pass *pass, const struct rg_target *target,
                       enum rg_access access)
{
    struct hazard_use *use = add_attachment(h, pass, target, access);
    use->needs_content = access == RG_DEPTH_READ || target->load == RG_LOAD_KEEP;
    if (target->resolve && access == RG_COLOR)
        add_attachment(h, pass, target, RG_RESOLVE);
}

static void add_row_use(struct hazard *h, struct hazard_pass *pass, const struct rg_use *row)
{
    struct hazard_use *use = add_use(h, pass, row->image, row->buffer, row->access);
    use->use = row;
    use->keeps_content = row->partial && use->gives_content;
    if (row->image)
        use->range =
            resolve(&h->resources[use->resource], &row->range, pass->pass->repeat, pass->step);
    if (use->stages)
        return;
    if (row->stages)
        use->stages = (row->stages & VK_SHADER_STAGE_VERTEX_BIT ? HAZARD_VERTEX : 0U) |
                      (row->stages & VK_SHADER_STAGE_FRAGMENT_BIT ? HAZARD_FRAGMENT : 0U) |
                      (row->stages & VK_SHADER_STAGE_COMPUTE_BIT ? HAZARD_COMPUTE : 0U);
    else if (pass->pass->kind == RG_COMPUTE)
        use->stages = HAZARD_COMPUTE;
    else
        use->stages = HAZARD_FRAGMENT | (row->access == RG_UNIFORM ? HAZARD_VERTEX : 0U);
}

/* Returns the number of a condition, counted from 1, or 0 if `when` is NULL. */
static uint32_t condition_of(struct hazard *h, rg_when_fn *when)
{
    uint32_t i = 0;
    if (!when)
        return 0;
    while (i < h->condition_count && h->conditions[i] != when)
        i++;
    if (i == HAZARD_CONDITIONS)
        abort();
    if (i == h->condition_count)
        h->conditions[h->condition_count++] = when;
    return i + 1;
}

static bool row_writes(const struct rg_pass *row, const struct rg_image *image)
{
    for (uint32_t i = 0; i < row->color_count && row->color[i].image; i++) {
        if (row->color[i].image == image || row->color[i].resolve == image)
            return true;
    }
    if (row->depth.image == image && !row->depth_read_only)
        return true;
    for (const struct rg_use *use = row->uses; use && use->access; use++) {
        if (use->image == image &&
            (use->access == RG_STORAGE_WRITE || use->access == RG_STORAGE_READ_WRITE ||
             use->access == RG_COPY_DST))
            return true;
    }
    return false;
}

/* Returns true if the use binds its fallback, because neither the image nor, of a history image,
 * its `previous` is written or imported. */
static bool falls_back(const struct hazard *h, const struct rg_use *use)
{
    const struct rg_compile_params *params = h->params;
    if (!use->fallback || !use->image)
        return false;
    const struct rg_image *image = use->image->previous ? use->image->previous : use->image;
    for (size_t i = 0; i < params->import_count; i++) {
        if (params->imports[i].image == image || params->imports[i].image == use->image)
            return false;
    }
    for (size_t t = 0; t < params->technique_count; t++) {
        const struct rg_technique *technique = params->techniques[t];
        for (size_t p = 0; p < technique->pass_count; p++) {
            if (row_writes(&technique->passes[p], image))
                return false;
        }
    }
    return true;
}

static void add_repetition(struct hazard *h, struct hazard_pass pass)
{
    const struct rg_pass *row = pass.pass;
    pass.condition = condition_of(h, row->when);
    pass.first_use = h->use_count;
    for (uint32_t i = 0; i < row->color_count && row->color[i].image; i++)
        add_target(h, &pass, &row->color[i], RG_COLOR);
    if (row->depth.image)
        add_target(h, &pass, &row->depth, row->depth_read_only ? RG_DEPTH_READ : RG_DEPTH);
    for (const struct rg_use *use = row->uses; use && use->access; use++) {
        if (!falls_back(h, use))
            add_row_use(h, &pass, use);
    }
    h->passes = hazard_grow(h->passes, &h->pass_capacity, h->pass_count + 1, sizeof(*h->passes));
    h->passes[h->pass_count++] = pass;
}

static void number_expected(struct hazard *h)
{
    for (uint32_t u = 0; u < h->use_count; u++) {
        struct hazard_use *use = &h->uses[u];
        const struct hazard_resource *resource = &h->resources[use->resource];
        use->first_expected = h->expected_count;
        for (uint32_t i = 0; hazard_next_subresource(resource, &use->range, &i) != RG_NONE;)
            h->expected_count++;
    }
}

/* Finds history images. Their `previous` is persistent, but swapped only if the history is read. */
static void pair_histories(struct hazard *h)
{
    for (uint32_t i = 0; i < h->resource_count; i++) {
        const struct rg_image *previous =
            h->resources[i].image ? h->resources[i].image->previous : NULL;
        if (!previous || h->resources[i].import)
            continue;
        const uint32_t other = add_resource(h, previous, NULL);
        h->resources[i].persistent = h->resources[other].persistent = true;
        if (h->resources[i].plan == RG_NONE)
            continue;
        h->resources[i].partner = other;
        h->resources[other].partner = i;
    }
}

void hazard_tables(struct hazard *h)
{
    const struct rg_compile_params *params = h->params;
    for (size_t i = 0; i < params->import_count; i++)
        add_resource(h, params->imports[i].image, params->imports[i].buffer);
    for (size_t t = 0; t < params->technique_count; t++) {
        const struct rg_technique *technique = params->techniques[t];
        for (uint32_t row = 0; row < technique->pass_count; row++) {
            struct hazard_pass pass = {
                .pass = &technique->passes[row],
                .technique = technique,
                .row = row,
            };
            uint32_t count = repetitions(h, pass.pass);
            for (pass.repetition = 0; pass.repetition < count; pass.repetition++) {
                const bool up = pass.pass->repeat == RG_PER_MIP_UP;
                pass.step = up ? count - 1 - pass.repetition : pass.repetition;
                add_repetition(h, pass);
            }
        }
    }
    for (size_t i = 0; i < params->output_count; i++)
        add_resource(h, params->outputs[i].image, params->outputs[i].buffer);
    pair_histories(h);
    number_expected(h);
}
