/*
 * rg_alias.c: the plan's images and buffers, and the block of memory of each.
 *
 * Transient resources whose lives do not overlap may share bytes (rg_pack.c). Images and buffers,
 * and resources of different memory types, live in blocks of their own, so bufferImageGranularity
 * never matters.
 */
#include <stdlib.h>
#include "graph/rg_internal.h"

VkImageCreateInfo rg_image_create_info(const struct rg_plan_image *image)
{
    return (VkImageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = image->flags,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = image->image->format,
        .extent = { image->extent.width, image->extent.height, 1 },
        .mipLevels = image->mips,
        .arrayLayers = image->layers,
        .samples = (VkSampleCountFlagBits)image->samples,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = image->usage,
        .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
    };
}

/* Without a device: tight sizes, so that plans are the same everywhere. */
static struct rg_memory_need estimate_image(const struct rg_plan_image *image)
{
    const struct rg_format_info *format = rg_format_info(image->image->format);
    VkDeviceSize texels = 0;
    for (uint32_t mip = 0; mip < image->mips; mip++) {
        VkDeviceSize width = image->extent.width >> mip;
        VkDeviceSize height = image->extent.height >> mip;
        texels += (width ? width : 1) * (height ? height : 1);
    }
    return (struct rg_memory_need){ texels * image->layers * format->size, 256, 1 };
}

static struct rg_memory_need image_need(const struct compiler *c, const struct rg_plan_image *image)
{
    const struct rg_device *device = c->params->device;
    if (!device || !device->image_memory)
        return estimate_image(image);
    const VkImageCreateInfo info = rg_image_create_info(image);
    return device->image_memory(device->user, &info);
}

static struct rg_memory_need buffer_need(const struct compiler *c,
                                         const struct rg_plan_buffer *buffer)
{
    const struct rg_device *device = c->params->device;
    if (!device || !device->buffer_memory)
        return (struct rg_memory_need){ buffer->size, 256, 1 };
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = buffer->size,
        .usage = buffer->usage,
    };
    return device->buffer_memory(device->user, &info);
}

static void list_image(struct compiler *c, struct resource *r, struct rg_plan_image *image)
{
    *image = (struct rg_plan_image){
        .image = r->image,
        .extent = r->extent,
        .layers = r->layers,
        .mips = r->mips,
        .aspects = r->aspects,
        .usage = r->usage,
        .flags = r->image->cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0,
        .samples = r->image->samples ? r->image->samples : 1,
        .imported = r->import != RG_NONE,
        .import = r->import,
        .first = r->first,
        .last = r->last,
        .block = RG_NONE,
    };
    if (!image->imported) {
        r->need = image_need(c, image);
        image->size = r->need.size;
    }
}

static void list_buffer(struct compiler *c, struct resource *r, struct rg_plan_buffer *buffer)
{
    *buffer = (struct rg_plan_buffer){
        .buffer = r->buffer,
        .size = r->size,
        .usage = r->usage,
        .imported = r->import != RG_NONE,
        .import = r->import,
        .first = r->first,
        .last = r->last,
        .block = RG_NONE,
    };
    if (!buffer->imported && r->buffer->memory == RG_MEMORY_DEVICE) {
        r->need = buffer_need(c, buffer);
        buffer->memory_size = r->need.size;
    }
}

static int by_first_use(const void *a, const void *b)
{
    const struct resource *x = *(struct resource *const *)a;
    const struct resource *y = *(struct resource *const *)b;
    if (x->first != y->first)
        return x->first < y->first ? -1 : 1;
    return x < y ? -1 : x > y; /* as listed in the tables */
}

/* Fills the plan's images and buffers, in order of first use. Returns how many `order` holds. */
static uint32_t list_resources(struct compiler *c, struct resource **order)
{
    struct rg_plan *plan = c->plan;
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->resource_count; i++) {
        if (c->resources[i].first != RG_NONE)
            order[count++] = &c->resources[i];
    }
    qsort(order, count, sizeof(*order), by_first_use); /* NOLINT: pointers are what is sorted */
    for (uint32_t i = 0; i < count; i++) {
        uint32_t *number = order[i]->image ? &plan->image_count : &plan->buffer_count;
        order[i]->plan_index = (*number)++;
    }
    plan->images = c->images = ARENA_ARRAY(c->arena, struct rg_plan_image, plan->image_count);
    plan->buffers = c->buffers = ARENA_ARRAY(c->arena, struct rg_plan_buffer, plan->buffer_count);
    if (c->arena->failed)
        return 0;
    for (uint32_t i = 0; i < count; i++) {
        if (order[i]->image)
            list_image(c, order[i], &c->images[order[i]->plan_index]);
        else
            list_buffer(c, order[i], &c->buffers[order[i]->plan_index]);
    }
    return count;
}

static bool is_placed(const struct resource *r)
{
    return r->import == RG_NONE && (r->image || r->buffer->memory == RG_MEMORY_DEVICE);
}

static bool same_block(const struct resource *a, const struct resource *b)
{
    return !a->image == !b->image && a->need.type_bits == b->need.type_bits;
}

/* Packs all resources of the kind of order[0] into one block and takes them out of the order. */
static uint32_t place_kind(struct compiler *c, struct resource **order, uint32_t count,
                           struct pack_item *items, struct rg_block *block)
{
    struct rg_plan *plan = c->plan;
    const struct resource *kind = order[0];
    uint32_t item_count = 0;
    uint32_t left = 0;
    *block = (struct rg_block){ .type_bits = kind->need.type_bits, .buffers = !kind->image };
    for (uint32_t i = 0; i < count; i++) {
        struct resource *r = order[i];
        if (!same_block(r, kind)) {
            order[left++] = r;
            continue;
        }
        if (block->alignment < r->need.alignment)
            block->alignment = r->need.alignment;
        items[item_count] = (struct pack_item){
            r->need.size, r->need.alignment, r->first, r->last, item_count, 0, r,
        };
        item_count++;
    }
    struct pack_result packed =
        rg_pack(&c->scratch, items, item_count, c->params->sharing == RG_SHARE_NOTHING);
    rg_overlap(&c->scratch, items, item_count);
    block->size = packed.size;
    plan->memory_used += packed.size;
    plan->memory_without_aliasing += packed.apart;
    plan->memory_bound += packed.bound;
    for (uint32_t i = 0; i < item_count; i++) {
        uint32_t index = items[i].resource->plan_index;
        if (items[i].resource->image) {
            c->images[index].block = plan->block_count;
            c->images[index].offset = items[i].offset;
        } else {
            c->buffers[index].block = plan->block_count;
            c->buffers[index].offset = items[i].offset;
        }
    }
    plan->block_count++;
    return left;
}

void rg_place(struct compiler *c)
{
    struct resource **order = ARENA_ARRAY(&c->scratch, struct resource *, c->resource_count);
    struct pack_item *items = ARENA_ARRAY(&c->scratch, struct pack_item, c->resource_count);
    struct rg_block *blocks = ARENA_ARRAY(c->arena, struct rg_block, c->resource_count);
    if (c->scratch.failed || c->arena->failed)
        return;
    uint32_t count = list_resources(c, order);
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (is_placed(order[i]))
            order[left++] = order[i];
    }
    while (left)
        left = place_kind(c, order, left, items, &blocks[c->plan->block_count]);
    c->plan->blocks = blocks;
}
