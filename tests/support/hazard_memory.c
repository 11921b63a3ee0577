/* hazard_memory.c: checks memory: sizes, usages, alignment, blocks, lifetimes and aliasing.
 */
#include "tests/support/hazard_private.h"

static const char *name_of(const struct hazard_resource *resource)
{
    return resource->image ? resource->image->name : resource->buffer->name;
}

struct hazard_binding hazard_memory_binding(const struct hazard *h,
                                            const struct hazard_resource *resource)
{
    if (resource->plan == RG_NONE)
        return (struct hazard_binding){ .block = RG_NONE };
    if (resource->image) {
        const struct rg_plan_image *image = &h->plan->images[resource->plan];
        return (struct hazard_binding){ image->block, image->offset, image->size,
                                        image->persistent };
    }
    const struct rg_plan_buffer *buffer = &h->plan->buffers[resource->plan];
    return (struct hazard_binding){ buffer->block, buffer->offset, buffer->memory_size,
                                    buffer->persistent };
}

static bool belongs_in_block(const struct hazard *h, const struct hazard_resource *resource)
{
    return !resource->import && !resource->persistent && !hazard_has_queues(h, resource) &&
           (resource->image || resource->buffer->memory == RG_MEMORY_DEVICE);
}

static struct rg_memory_requirements image_need(const struct hazard *h,
                                                const struct hazard_resource *resource)
{
    const struct rg_plan_image *planned = &h->plan->images[resource->plan];
    const struct rg_device *device = h->params->device;
    VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = planned->flags,
        .imageType = resource->image->depth ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D,
        .format = resource->image->format,
        .extent = { resource->extent.width, resource->extent.height, resource->depth },
        .mipLevels = resource->mips,
        .arrayLayers = resource->layers,
        .samples = (VkSampleCountFlagBits)resource->samples,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = planned->usage,
    };
    if (device && device->image_memory)
        return device->image_memory(device->user, &info);
    struct rg_memory_requirements need = { .alignment = 256, .type_bits = 1 };
    for (uint32_t mip = 0; mip < resource->mips; mip++) {
        VkDeviceSize width = resource->extent.width >> mip, height = resource->extent.height >> mip;
        VkDeviceSize depth = resource->depth >> mip;
        need.size += (width ? width : 1) * (height ? height : 1) * (depth ? depth : 1) *
                     resource->layers * resource->samples *
                     hazard_texel_size(resource->image->format);
    }
    return need;
}

static struct rg_memory_requirements buffer_need(const struct hazard *h,
                                                 const struct hazard_resource *resource)
{
    const struct rg_plan_buffer *planned = &h->plan->buffers[resource->plan];
    const struct rg_device *device = h->params->device;
    VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = planned->size,
        .usage = planned->usage,
    };
    if (device && device->buffer_memory)
        return device->buffer_memory(device->user, &info);
    return (
        struct rg_memory_requirements){ .size = planned->size, .alignment = 256, .type_bits = 1 };
}

static void check_place(struct hazard *h, const struct hazard_resource *resource)
{
    struct hazard_binding place = hazard_memory_binding(h, resource);
    const char *name = name_of(resource);
    if (place.persistent != resource->persistent)
        hazard_report(h, "'%s' has the wrong persistence", name);
    struct rg_memory_requirements need = { 0 };
    if (!resource->import)
        need = resource->image ? image_need(h, resource) : buffer_need(h, resource);
    VkDeviceSize alignment = need.alignment ? need.alignment : 1;
    if (place.size < need.size && (resource->persistent || belongs_in_block(h, resource)))
        hazard_report(h, "'%s' has too little memory", name);
    if (!belongs_in_block(h, resource)) {
        if (place.block != RG_NONE)
            hazard_report(h, "'%s' is not transient but has memory in a block", name);
        return;
    }
    if (place.block >= h->plan->block_count) {
        hazard_report(h, "'%s' has no block", name);
        return;
    }
    const struct rg_block *block = &h->plan->blocks[place.block];
    if (block->buffers != (resource->buffer != NULL))
        hazard_report(h, "'%s' is in a block for the other kind of resource", name);
    if (place.size > block->size || place.offset > block->size - place.size)
        hazard_report(h, "'%s' ends beyond its block", name);
    if (place.offset % alignment != 0 || block->alignment % alignment != 0)
        hazard_report(h, "'%s' is misaligned", name);
    if (!block->type_bits || (block->type_bits & ~need.type_bits))
        hazard_report(h, "'%s' does not support its block's memory types", name);
}

static void check_image(struct hazard *h, const struct hazard_resource *resource)
{
    const struct rg_plan_image *image = &h->plan->images[resource->plan];
    if (image->extent.width != resource->extent.width ||
        image->extent.height != resource->extent.height || image->depth != resource->depth ||
        image->layers != resource->layers || image->mips != resource->mips ||
        image->aspects != resource->aspects || image->samples != resource->samples)
        hazard_report(h, "'%s' has another shape than declared", name_of(resource));
    if (resource->image->cube && !(image->flags & VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT))
        hazard_report(h, "'%s' cannot be viewed as a cube", name_of(resource));
    if (resource->persistent && !(image->usage & VK_IMAGE_USAGE_TRANSFER_DST_BIT))
        hazard_report(h, "'%s' cannot be filled with zeros", name_of(resource));
    const uint32_t partner =
        resource->partner == RG_NONE ? RG_NONE : h->resources[resource->partner].plan;
    const struct rg_plan_image *other = partner == RG_NONE ? image : &h->plan->images[partner];
    if (image->partner != partner || image->usage != other->usage || image->flags != other->flags ||
        image->queues != other->queues)
        hazard_report(h, "'%s' has a wrong partner, or differs from it in usage, flags or queues",
                      name_of(resource));
}

static void check_import(struct hazard *h, const struct hazard_resource *resource, bool imported,
                         uint32_t import)
{
    uint32_t expected =
        resource->import ? (uint32_t)(resource->import - h->params->imports) : RG_NONE;
    if (imported != (resource->import != NULL) || import != expected)
        hazard_report(h, "'%s' names the wrong import", name_of(resource));
}

/* Checks usage flags for an access; `texels` is true if it uses a storage texel buffer view. */
static void check_usage(struct hazard *h, const struct hazard_resource *resource,
                        enum rg_access access, bool texels)
{
    const struct hazard_rule *rule = hazard_rule(access);
    VkBufferUsageFlags of_buffer =
        texels ? VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT : rule->buffer_usage;
    bool allowed;
    if (resource->image)
        allowed = !(rule->image_usage & ~h->plan->images[resource->plan].usage);
    else
        allowed = !(of_buffer & ~h->plan->buffers[resource->plan].usage);
    if (!allowed)
        hazard_report(h, "'%s' lacks a usage flag for access %d", name_of(resource), (int)access);
}

/* Checks that the image of a use with a view format of its own allows such views. */
static void check_view(struct hazard *h, const struct hazard_resource *resource,
                       const struct rg_use *use)
{
    if (use && use->view_format && resource->image && !resource->import &&
        use->view_format != resource->image->format &&
        !(h->plan->images[resource->plan].flags & VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT))
        hazard_report(h, "'%s' cannot be viewed in another format", name_of(resource));
}

/* Checks that a resource is shared with the queue of a pass that uses it. */
static void check_queue(struct hazard *h, const struct hazard_resource *resource, uint32_t pass)
{
    const uint32_t queues = resource->image ? h->plan->images[resource->plan].queues
                                            : h->plan->buffers[resource->plan].queues;
    if (h->plan->submission_count && !(queues >> hazard_queue_of(h, HAZARD_FIRST_SLOT + pass) & 1))
        hazard_report(h, "'%s' is not shared with the queue of pass %u", name_of(resource), pass);
}

/* Computes the first and last pass that uses each resource, and checks usage flags and queues. */
static void check_uses(struct hazard *h)
{
    for (uint32_t p = 0; p < h->plan->pass_count; p++) {
        const struct hazard_pass *pass = &h->passes[h->plan_passes[p]];
        for (uint32_t u = pass->first_use; u < pass->first_use + pass->use_count; u++) {
            struct hazard_resource *resource = &h->resources[h->uses[u].resource];
            if (h->uses[u].dropped)
                continue;
            if (resource->first == RG_NONE)
                resource->first = p;
            resource->last = p;
            if (resource->plan == RG_NONE) {
                hazard_report(h, "'%s' is used but not in the plan", name_of(resource));
                continue;
            }
            check_queue(h, resource, p);
            check_view(h, resource, h->uses[u].use);
            check_usage(h, resource, h->uses[u].access, h->uses[u].use && h->uses[u].use->texels);
        }
    }
    for (uint32_t r = 0; r < h->resource_count; r++) {
        struct hazard_resource *resource = &h->resources[r];
        if (!resource->output)
            continue;
        resource->last = h->plan->pass_count;
        if (resource->plan == RG_NONE)
            hazard_report(h, "output '%s' is not in the plan", name_of(resource));
        else
            check_usage(h, resource, resource->output->access, false);
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
    if ((first != resource->first && resource->first != RG_NONE) || last != resource->last)
        hazard_report(h, "'%s' lives from pass %u to %u, but is used from %u to %u",
                      name_of(resource), first, last, resource->first, resource->last);
}

static bool overlap(struct hazard_binding a, struct hazard_binding b)
{
    return a.block != RG_NONE && a.block == b.block && a.offset < b.offset + b.size &&
           b.offset < a.offset + a.size;
}

static void find_aliases(struct hazard *h, uint32_t index)
{
    struct hazard_resource *a = &h->resources[index];
    struct hazard_binding place = hazard_memory_binding(h, a);
    a->first_alias = h->alias_count;
    for (uint32_t i = 0; i < h->resource_count; i++) {
        const struct hazard_resource *b = &h->resources[i];
        if (i == index || !overlap(place, hazard_memory_binding(h, b)))
            continue;
        h->aliases =
            hazard_grow(h->aliases, &h->alias_capacity, h->alias_count + 1, sizeof(*h->aliases));
        h->aliases[h->alias_count++] = i;
        a->alias_count++;
        if (i > index && h->params->sharing == RG_SHARE_NOTHING)
            hazard_report(h, "'%s' and '%s' share memory", name_of(a), name_of(b));
        else if (i > index && a->first <= b->last && b->first <= a->last)
            hazard_report(h, "'%s' and '%s' share memory while both are alive", name_of(a),
                          name_of(b));
    }
}

void hazard_check_memory(struct hazard *h)
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
            if (buffer->size != resource->size)
                hazard_report(h, "'%s' has another size than declared", name_of(resource));
            if (resource->persistent && !(buffer->usage & VK_BUFFER_USAGE_TRANSFER_DST_BIT))
                hazard_report(h, "'%s' cannot be filled with zeros", name_of(resource));
        }
    }
    for (uint32_t r = 0; r < h->resource_count; r++)
        find_aliases(h, r);
}
