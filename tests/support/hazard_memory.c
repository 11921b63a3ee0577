/* Where resources lie: sizes, usages, alignment, blocks, lifetimes and who shares memory. */
#include "tests/support/hazard_private.h"

struct place {
    uint32_t block;
    VkDeviceSize offset, size;
};

static const char *name_of(const struct hazard_resource *resource)
{
    return resource->image ? resource->image->name : resource->buffer->name;
}

static struct place place_of(const struct hazard *h, const struct hazard_resource *resource)
{
    if (resource->plan == RG_NONE)
        return (struct place){ .block = RG_NONE };
    if (resource->image) {
        const struct rg_plan_image *image = &h->plan->images[resource->plan];
        return (struct place){ image->block, image->offset, image->size };
    }
    const struct rg_plan_buffer *buffer = &h->plan->buffers[resource->plan];
    return (struct place){ buffer->block, buffer->offset, buffer->memory_size };
}

static bool belongs_in_block(const struct hazard_resource *resource)
{
    return !resource->import && (resource->image || resource->buffer->memory == RG_MEMORY_DEVICE);
}

static struct rg_memory_need image_need(const struct hazard *h,
                                        const struct hazard_resource *resource)
{
    const struct rg_plan_image *planned = &h->plan->images[resource->plan];
    const struct rg_device *device = h->params->device;
    VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = planned->flags,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = resource->image->format,
        .extent = { resource->extent.width, resource->extent.height, 1 },
        .mipLevels = resource->mips,
        .arrayLayers = resource->layers,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = planned->usage,
    };
    if (device)
        return device->image_memory(device->user, &info);
    struct rg_memory_need need = { .alignment = 256, .type_bits = 1 };
    for (uint32_t mip = 0; mip < resource->mips; mip++) {
        VkDeviceSize width = resource->extent.width >> mip, height = resource->extent.height >> mip;
        need.size += (width ? width : 1) * (height ? height : 1) * resource->layers *
                     hazard_texel_size(resource->image->format);
    }
    return need;
}

static VkDeviceSize buffer_size(const struct hazard *h, const struct rg_buffer *buffer)
{
    VkDeviceSize texels = (VkDeviceSize)h->params->view.width * h->params->view.height;
    return buffer->size + buffer->size_per_texel * texels;
}

static struct rg_memory_need buffer_need(const struct hazard *h,
                                         const struct hazard_resource *resource)
{
    const struct rg_plan_buffer *planned = &h->plan->buffers[resource->plan];
    const struct rg_device *device = h->params->device;
    VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = planned->size,
        .usage = planned->usage,
    };
    if (device)
        return device->buffer_memory(device->user, &info);
    return (struct rg_memory_need){ .size = planned->size, .alignment = 256, .type_bits = 1 };
}

static void check_place(struct hazard *h, const struct hazard_resource *resource)
{
    struct place place = place_of(h, resource);
    const char *name = name_of(resource);
    if (!belongs_in_block(resource)) {
        if (place.block != RG_NONE)
            hazard_find(h, "'%s' is not transient but has memory in a block", name);
        return;
    }
    if (place.block >= h->plan->block_count) {
        hazard_find(h, "'%s' has no block", name);
        return;
    }
    const struct rg_block *block = &h->plan->blocks[place.block];
    struct rg_memory_need need =
        resource->image ? image_need(h, resource) : buffer_need(h, resource);
    if (block->buffers != (resource->buffer != NULL))
        hazard_find(h, "'%s' lies in a block of the other kind", name);
    if (place.size < need.size)
        hazard_find(h, "'%s' has too little memory", name);
    if (place.size > block->size || place.offset > block->size - place.size)
        hazard_find(h, "'%s' ends beyond its block", name);
    if (place.offset % need.alignment != 0 || block->alignment % need.alignment != 0)
        hazard_find(h, "'%s' is misaligned", name);
    if (!block->type_bits || (block->type_bits & ~need.type_bits))
        hazard_find(h, "'%s' cannot lie in its block's memory types", name);
}

static void check_image(struct hazard *h, const struct hazard_resource *resource)
{
    const struct rg_plan_image *image = &h->plan->images[resource->plan];
    if (image->extent.width != resource->extent.width ||
        image->extent.height != resource->extent.height || image->layers != resource->layers ||
        image->mips != resource->mips || image->aspects != resource->aspects)
        hazard_find(h, "'%s' has another shape than declared", name_of(resource));
    if (resource->image->cube && !(image->flags & VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT))
        hazard_find(h, "'%s' cannot be viewed as a cube", name_of(resource));
}

static void check_import(struct hazard *h, const struct hazard_resource *resource, bool imported,
                         uint32_t import)
{
    uint32_t expected =
        resource->import ? (uint32_t)(resource->import - h->params->imports) : RG_NONE;
    if (imported != (resource->import != NULL) || import != expected)
        hazard_find(h, "'%s' names the wrong import", name_of(resource));
}

static void check_usage(struct hazard *h, const struct hazard_resource *resource,
                        enum rg_access access)
{
    const struct hazard_rule *rule = hazard_rule(access);
    bool allowed;
    if (resource->image)
        allowed = !(rule->image_usage & ~h->plan->images[resource->plan].usage);
    else
        allowed = !(rule->buffer_usage & ~h->plan->buffers[resource->plan].usage);
    if (!allowed)
        hazard_find(h, "'%s' lacks a usage flag for access %d", name_of(resource), (int)access);
}

/* Finds from when to when living passes touch each resource, and whether its usage lets them. */
static void check_uses(struct hazard *h)
{
    for (uint32_t p = 0; p < h->plan->pass_count; p++) {
        const struct hazard_pass *pass = &h->passes[h->plan_passes[p]];
        for (uint32_t u = pass->first_use; u < pass->first_use + pass->use_count; u++) {
            struct hazard_resource *resource = &h->resources[h->uses[u].resource];
            if (resource->first == RG_NONE)
                resource->first = p;
            resource->last = p;
            if (resource->plan == RG_NONE)
                hazard_find(h, "'%s' is used but not in the plan", name_of(resource));
            else
                check_usage(h, resource, h->uses[u].access);
        }
    }
    for (uint32_t r = 0; r < h->resource_count; r++) {
        struct hazard_resource *resource = &h->resources[r];
        if (!resource->output)
            continue;
        resource->last = h->plan->pass_count;
        if (resource->plan == RG_NONE)
            hazard_find(h, "output '%s' is not in the plan", name_of(resource));
        else
            check_usage(h, resource, resource->output->access);
    }
}

static void check_life(struct hazard *h, const struct hazard_resource *resource)
{
    uint32_t first, last;
    if (resource->image) {
        first = h->plan->images[resource->plan].first;
        last = h->plan->images[resource->plan].last;
    } else {
        first = h->plan->buffers[resource->plan].first;
        last = h->plan->buffers[resource->plan].last;
    }
    if (first != resource->first || last != resource->last)
        hazard_find(h, "'%s' lives from pass %u to %u, but is used from %u to %u",
                    name_of(resource), first, last, resource->first, resource->last);
}

static bool overlap(struct place a, struct place b)
{
    return a.block != RG_NONE && a.block == b.block && a.offset < b.offset + b.size &&
           b.offset < a.offset + a.size;
}

static void find_aliases(struct hazard *h, uint32_t index)
{
    struct hazard_resource *a = &h->resources[index];
    struct place place = place_of(h, a);
    a->first_alias = h->alias_count;
    for (uint32_t i = 0; i < h->resource_count; i++) {
        const struct hazard_resource *b = &h->resources[i];
        if (i == index || !overlap(place, place_of(h, b)))
            continue;
        h->aliases =
            hazard_grow(h->aliases, &h->alias_room, h->alias_count + 1, sizeof(*h->aliases));
        h->aliases[h->alias_count++] = i;
        a->alias_count++;
        if (i > index && h->params->sharing == RG_SHARE_NOTHING)
            hazard_find(h, "'%s' and '%s' share memory", name_of(a), name_of(b));
        else if (i > index && a->first <= b->last && b->first <= a->last)
            hazard_find(h, "'%s' and '%s' share memory while both are alive", name_of(a),
                        name_of(b));
    }
}

void hazard_memory(struct hazard *h)
{
    check_uses(h);
    for (uint32_t r = 0; r < h->resource_count; r++) {
        const struct hazard_resource *resource = &h->resources[r];
        if (resource->plan == RG_NONE)
            continue;
        check_place(h, resource);
        check_life(h, resource);
        if (resource->image) {
            const struct rg_plan_image *image = &h->plan->images[resource->plan];
            check_image(h, resource);
            check_import(h, resource, image->imported, image->import);
        } else {
            const struct rg_plan_buffer *buffer = &h->plan->buffers[resource->plan];
            check_import(h, resource, buffer->imported, buffer->import);
            if (buffer->size != buffer_size(h, resource->buffer))
                hazard_find(h, "'%s' has another size than declared", name_of(resource));
        }
    }
    for (uint32_t r = 0; r < h->resource_count; r++)
        find_aliases(h, r);
    VkDeviceSize used = 0;
    for (uint32_t i = 0; i < h->plan->block_count; i++)
        used += h->plan->blocks[i].size;
    if (used != h->plan->memory_used)
        hazard_find(h, "memory_used is not the sum of the blocks");
}
