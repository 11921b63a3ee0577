/* requirements.c: the plan's images and buffers, in the order of first use, and their memory. */
#include "graph/compile/compiler.h"

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

/* ---- what living passes do ---- */

static void check_format(struct compiler *c, const struct pass *pass, const struct access *access)
{
    const struct rg_device *device = c->params->device;
    const struct resource *r = access->resource;
    enum rg_access kind = access->effect->access;
    VkFormatFeatureFlags wanted = rg_access_table[kind].format_features;
    if (kind == RG_SAMPLED) {
        const struct rg_use *use = access->declared;
        if (use->sampler && use->sampler->linear)
            wanted |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    }
    if (kind == RG_COLOR) {
        const struct rg_target *target = access->declared;
        if (target->blend)
            wanted |= VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
    }
    if (wanted & ~device->format_features(device->user, r->image->format))
        rg_fault_add(c, RG_ERROR_FORMAT,
                     (struct place){ pass->technique, pass->row, rg_resource_name(r) },
                     "this device cannot use the format so; choose another format or device");
}

void rg_check_formats(struct compiler *c)
{
    const struct rg_device *device = c->params->device;
    if (!device || !device->format_features)
        return;
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        if (!pass->alive)
            continue;
        if (!pass->repetition)
            c->row_first_fault = c->fault_count;
        for (uint32_t i = 0; i < pass->access_count; i++) {
            const struct access *a = &c->accesses[pass->first_access + i];
            if (a->resource->image)
                check_format(c, pass, a);
        }
    }
}

void rg_follow_passes(struct compiler *c)
{
    uint32_t index = 0;
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        for (uint32_t i = 0; i < pass->access_count && pass->alive; i++) {
            const struct access *a = &c->accesses[pass->first_access + i];
            rg_follow(c, a->resource, a->effect->usage, index);
        }
        index += pass->alive;
    }
}

void rg_follow_outputs(struct compiler *c)
{
    for (size_t i = 0; i < c->params->output_count; i++) {
        const struct rg_output *output = &c->params->outputs[i];
        struct resource *r = rg_resource_of(c, output->image, output->buffer);
        rg_follow(c, r, rg_usage(r, output->access), c->plan->pass_count);
    }
}

/* ---- the lists ---- */

/* Without a device: tight sizes, so that plans are the same everywhere. */
static VkDeviceSize estimate_image(const struct resource *r)
{
    VkDeviceSize texels = (VkDeviceSize)r->extent.width * r->extent.height;
    if (r->plain)
        return texels * r->format->size;
    for (uint32_t mip = 1; mip < r->all.levelCount; mip++) {
        VkDeviceSize width = r->extent.width >> mip;
        VkDeviceSize height = r->extent.height >> mip;
        texels += (width ? width : 1) * (height ? height : 1);
    }
    texels *= (VkDeviceSize)r->all.layerCount * (r->image->samples ? r->image->samples : 1);
    return texels * r->format->size;
}

static struct rg_memory_requirements checked_need(struct rg_memory_requirements need)
{
    need.alignment = need.alignment ? need.alignment : 1;
    return need;
}

static inline struct rg_memory_requirements
image_need(const struct compiler *c, const struct resource *r, const struct rg_plan_image *image)
{
    const struct rg_device *device = c->params->device;
    if (!device || !device->image_memory)
        return (struct rg_memory_requirements){ estimate_image(r), 256, 1 };
    const VkImageCreateInfo info = rg_image_create_info(image);
    return checked_need(device->image_memory(device->user, &info));
}

static struct rg_memory_requirements buffer_need(const struct compiler *c,
                                                 const struct rg_plan_buffer *buffer)
{
    const struct rg_device *device = c->params->device;
    if (!device || !device->buffer_memory)
        return (struct rg_memory_requirements){ buffer->size, 256, 1 };
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = buffer->size,
        .usage = buffer->usage,
    };
    return checked_need(device->buffer_memory(device->user, &info));
}

static void check_samples(struct compiler *c, const struct rg_plan_image *image)
{
    const struct rg_device *device = c->params->device;
    if (image->samples == 1 || !device || !device->sample_counts)
        return;
    VkImageCreateInfo info = rg_image_create_info(image);
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    if (!(device->sample_counts(device->user, &info) & image->samples))
        rg_fault_add(c, RG_ERROR_SAMPLES,
                     (struct place){ .row = RG_NONE, .resource = image->image->name },
                     "this device has no such images of so many samples; ask for fewer");
}

/* As an item to be placed, of an image or a buffer; NULL: it has memory of its own. */
static inline struct pack_item *need_memory(struct compiler *c, struct resource *r,
                                            const struct rg_memory_requirements *need)
{
    if (r->item == RG_NONE) {
        c->plan->memory_persistent += need->size;
        return NULL;
    }
    struct pack_item *item = &c->items[r->item];
    item->size = need->size;
    item->alignment = need->alignment;
    item->resource = r;
    item->first_use = r->first;
    item->last = r->last;
    item->first = r->taken;
    item->type_bits = need->type_bits;
    item->is_buffer = !r->image;
    return item;
}

/* Field by field, as wherever much is written (rg_emit.c). */
static void list_image(struct compiler *c, struct resource *r, struct rg_plan_image *image)
{
    image->image = r->image;
    image->extent = r->extent;
    image->layers = r->all.layerCount;
    image->mips = r->all.levelCount;
    image->aspects = r->all.aspectMask;
    image->usage = r->usage;
    image->flags = r->image->cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
    image->samples = r->image->samples ? r->image->samples : 1;
    image->imported = r->import != RG_NONE;
    image->persistent = r->persistent;
    image->import = r->import;
    image->first = r->first;
    image->last = r->last;
    image->block = RG_NONE;
    image->offset = image->size = 0;
    if (image->imported)
        return;
    check_samples(c, image);
    const struct rg_memory_requirements need = image_need(c, r, image);
    image->size = need.size;
    struct pack_item *item = need_memory(c, r, &need);
    if (item)
        item->image = image;
}

static void list_buffer(struct compiler *c, struct resource *r, struct rg_plan_buffer *buffer)
{
    *buffer = (struct rg_plan_buffer){
        .buffer = r->buffer,
        .size = r->size,
        .usage = r->usage,
        .imported = r->import != RG_NONE,
        .persistent = r->persistent,
        .import = r->import,
        .first = r->first,
        .last = r->last,
        .block = RG_NONE,
    };
    if (buffer->imported || r->buffer->memory != RG_MEMORY_DEVICE)
        return;
    const struct rg_memory_requirements need = buffer_need(c, buffer);
    buffer->memory_size = need.size;
    struct pack_item *item = need_memory(c, r, &need);
    if (item)
        item->buffer = buffer;
}

void rg_list(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    plan->images = c->images = ARENA_ARRAY(c->arena, struct rg_plan_image, plan->image_count);
    plan->buffers = c->buffers = ARENA_ARRAY(c->arena, struct rg_plan_buffer, plan->buffer_count);
    c->items = ARENA_ARRAY(c->arena, struct pack_item, c->item_count);
    if (c->arena->failed)
        return;
    for (struct resource *r = c->resources, *end = r + c->resource_count; r < end; r++) {
        if (r->first == RG_NONE)
            continue;
        if (r->image)
            list_image(c, r, &c->images[r->plan_image]);
        else
            list_buffer(c, r, &c->buffers[r->plan_buffer]);
    }
}
