/* memory_requirements.c: lifetimes and memory requirements of the plan's images and buffers. */
#include "graph/compile/compiler.h"

VkImageCreateInfo rg_image_create_info(const struct rg_plan_image *image)
{
    return (VkImageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = image->flags,
        .imageType = image->image->depth ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D,
        .format = image->image->format,
        .extent = { image->extent.width, image->extent.height, image->depth },
        .mipLevels = image->mips,
        .arrayLayers = image->layers,
        .samples = (VkSampleCountFlagBits)image->samples,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = image->usage,
        .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
    };
}

/* Extends a resource's lifetime to a pass. At its first access, assigns its index in the plan. */
static void extend_lifetime(struct compiler *c, struct resource *r, VkFlags usage, uint32_t pass)
{
    if (r->first == RG_NONE) {
        r->first = r->acquired_before = pass;
        if (r->image)
            r->plan_image = c->plan->image_count++;
        else
            r->plan_buffer = c->plan->buffer_count++;
        if (r->persistent)
            usage |= r->image ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : VK_BUFFER_USAGE_TRANSFER_DST_BIT;
        if (r->shared)
            r->item = c->item_count++;
    }
    r->last = pass;
    r->usage |= usage;
}

/* Prepares a resource for accesses by another queue. It does not alias others, because memory is
 * handed on by barriers, which only order commands of one queue. */
static void add_queue(struct compiler *c, struct resource *r, enum rg_queue queue)
{
    r->queues |= (uint8_t)(1u << queue);
    if (!r->queue_cells)
        r->queue_cells = ARENA_ZEROED(c->arena, struct cell_queues, r->cell_count);
    for (uint32_t k = 0; k < r->cell_count && r->shared; k++) {
        r->cells[k].flags = 0;
        /* of the previous frame */
        r->cells[k].write_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        r->cells[k].write_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
    }
    r->shared = false;
    c->has_queues = true;
}

static void find_queues(struct compiler *c)
{
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        const struct access *a = &c->accesses[pass->first_access];
        for (uint32_t i = 0; i < pass->access_count && pass->queue != RG_QUEUE_MAIN; i++) {
            add_queue(c, a[i].resource, pass->queue);
            if (a[i].resource->partner)
                add_queue(c, a[i].resource->partner, pass->queue);
        }
    }
}

static VkFlags usage_of(const struct access *a)
{
    return a->flags & ACCESS_TEXELS && a->kind != RG_SAMPLED
               ? VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT
               : rg_usage(a->resource, a->kind);
}

/* Returns the features that a device needs for an access to an image. */
static VkFormatFeatureFlags features_of(const struct access *a, const struct rg_use *use)
{
    const struct rg_sampler *sampler = a->kind == RG_SAMPLED ? use->sampler : NULL;
    VkFormatFeatureFlags needed = rg_access_table[a->kind].format_features;
    if (sampler && sampler->linear && !sampler->compare)
        needed |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (sampler && sampler->reduction)
        needed |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_MINMAX_BIT;
    if (a->kind == RG_COLOR && rg_is_blended(a->declared))
        needed |= VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
    return needed;
}

static void check_format(struct compiler *c, const struct access *a)
{
    const struct rg_device *device = c->params->device;
    const struct resource *r = a->resource;
    const struct rg_use *use = rg_is_shader_access(a->kind) ? a->declared : NULL;
    VkFormatFeatureFlags missing = 0;
    if (r->image && device->format_features)
        missing =
            features_of(a, use) &
            ~device->format_features(device->user, use ? rg_view_format(use) : r->image->format);
    if (a->flags & ACCESS_TEXELS && device->buffer_features)
        missing = (a->kind == RG_SAMPLED ? VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT
                                         : VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT) &
                  ~device->buffer_features(device->user, r->buffer->format);
    if (missing)
        rg_fault(c, RG_ERROR_FORMAT, r->name,
                 "this device does not support this use of the format; choose another");
}

void rg_find_lifetimes(struct compiler *c)
{
    const bool has_device = c->params->device;
    if (c->params->queues)
        find_queues(c);
    for (uint32_t p = 0; p < c->pass_count; p++) {
        const struct pass *pass = &c->passes[p];
        const struct access *a = &c->accesses[pass->first_access];
        if (has_device) { /* for faults */
            c->technique = c->plan_passes[p].technique;
            c->row = c->plan_passes[p].row;
            if (!c->plan_passes[p].repetition)
                c->row_first_fault = c->fault_count;
        }
        for (uint32_t i = 0; i < pass->access_count; i++) {
            extend_lifetime(c, a[i].resource, usage_of(&a[i]), p);
            if (has_device)
                check_format(c, &a[i]);
        }
    }
    for (size_t i = 0; i < c->params->output_count; i++) {
        const struct rg_output *output = &c->params->outputs[i];
        struct resource *r = rg_resource_of(c, output->image, output->buffer);
        extend_lifetime(c, r, rg_usage(r, output->access), c->pass_count);
    }
    for (uint32_t i = 0; i < c->resource_count && c->persistent_count; i++) {
        struct resource *r = c->resources[i];
        if (rg_is_history(r) && r->first == RG_NONE) /* no pass reads it */
            r->partner = r->partner->partner = NULL;
    }
}

static void check_samples(struct compiler *c, const struct rg_plan_image *image)
{
    const struct rg_device *device = c->params->device;
    if (image->samples == 1 || !device || !device->sample_counts)
        return;
    VkImageCreateInfo info = rg_image_create_info(image);
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    if (!(device->sample_counts(device->user, &info) & image->samples))
        rg_fault_of(c, RG_ERROR_SAMPLES, image->image->name,
                    "this device does not support this sample count for such images; use fewer");
}

/* Returns an image's tightly packed size in bytes, for plans that are compiled without a device. */
static VkDeviceSize estimate_image(const struct rg_plan_image *image)
{
    VkDeviceSize texels = 0;
    for (uint32_t mip = 0; mip < image->mips; mip++)
        texels += (VkDeviceSize)rg_mip_side(image->extent.width, mip) *
                  rg_mip_side(image->extent.height, mip) * rg_mip_side(image->depth, mip);
    return texels * image->layers * image->samples * rg_format_info(image->image->format)->size;
}

static struct rg_memory_requirements image_memory(const struct compiler *c,
                                                  const struct rg_plan_image *image)
{
    const struct rg_device *device = c->params->device;
    if (!device || !device->image_memory)
        return (struct rg_memory_requirements){ estimate_image(image), 256, 1 };
    const VkImageCreateInfo info = rg_image_create_info(image);
    return device->image_memory(device->user, &info);
}

static struct rg_memory_requirements buffer_memory(const struct compiler *c, VkDeviceSize size,
                                                   VkBufferUsageFlags usage)
{
    const struct rg_device *device = c->params->device;
    if (!device || !device->buffer_memory)
        return (struct rg_memory_requirements){ size, 256, 1 };
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = size,
        .usage = usage,
    };
    return device->buffer_memory(device->user, &info);
}

/* Returns memory requirements that suffice for both the current and the largest view size. */
static struct rg_memory_requirements combine_requirements(struct rg_memory_requirements a,
                                                          const struct rg_memory_requirements *b)
{
    a.size = a.size > b->size ? a.size : b->size;
    a.alignment = a.alignment > b->alignment ? a.alignment : b->alignment;
    a.type_bits &= b->type_bits;
    return a;
}

/* Records the memory requirements of a transient or persistent resource. */
static void add_memory(struct compiler *c, struct resource *r,
                       const struct rg_memory_requirements *required)
{
    c->memory_needed += required->size + required->alignment;
    if (r->item == RG_NONE)
        c->plan->memory_persistent += required->size;
    else
        c->items[r->item] = (struct pack_item){
            .size = required->size,
            .alignment = required->alignment ? required->alignment : 1,
            .last = r->last,
            .type_bits = required->type_bits,
            .resource = r,
        };
    if (!required->size || !required->type_bits || required->alignment & (required->alignment - 1))
        rg_fault_of(c, RG_ERROR_DEVICE, r->name,
                    "memory: expected a size, a memory type and a power-of-two alignment");
    /* so that no sum overflows */
    else if ((required->size | required->alignment | c->memory_needed) >> 62)
        rg_fault_of(c, RG_ERROR_TOO_LARGE, r->name,
                    "make it smaller: the resources so far exceed any memory");
}

static void list_image(struct compiler *c, struct resource *r)
{
    const VkImageCreateFlags mutable_flags =
        VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT | VK_IMAGE_CREATE_EXTENDED_USAGE_BIT;
    struct rg_plan_image *image = &c->images[r->plan_image];
    image->image = r->image;
    image->extent = r->extent;
    image->depth = r->depth;
    image->layers = r->all.layer_count;
    image->mips = r->all.mip_count;
    image->aspects = r->all.aspects;
    image->usage = r->usage | (r->partner ? r->partner->usage : 0);
    image->flags = (r->image->cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0) |
                   (r->is_mutable || (r->partner && r->partner->is_mutable) ? mutable_flags : 0);
    image->samples = r->image->samples ? r->image->samples : 1;
    image->imported = r->import != RG_NONE;
    image->persistent = r->persistent;
    image->import = r->import;
    image->partner = r->partner ? r->partner->plan_image : RG_NONE;
    image->queues = r->queues | 1u << RG_QUEUE_MAIN;
    image->first = r->first;
    image->last = r->last;
    image->block = RG_NONE;
    image->offset = image->size = 0;
    if (image->imported)
        return;
    check_samples(c, image);
    struct rg_memory_requirements required = image_memory(c, image);
    if (r->max_extent.width != r->extent.width || r->max_extent.height != r->extent.height) {
        struct rg_plan_image largest = *image;
        largest.extent = r->max_extent;
        if (r->image->mips == RG_ALL_MIPS)
            largest.mips = rg_full_chain(r->max_extent, r->depth);
        const struct rg_memory_requirements most = image_memory(c, &largest);
        required = combine_requirements(required, &most);
    }
    image->size = required.size;
    add_memory(c, r, &required);
}

static void list_buffer(struct compiler *c, struct resource *r)
{
    const VkFlags structure = VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR;
    struct rg_plan_buffer *buffer = &c->buffers[r->plan_buffer];
    buffer->buffer = r->buffer;
    buffer->size = r->size;
    buffer->usage = r->usage;
    buffer->imported = r->import != RG_NONE;
    buffer->persistent = r->persistent;
    buffer->import = r->import;
    buffer->queues = r->queues | 1u << RG_QUEUE_MAIN;
    buffer->first = r->first;
    buffer->last = r->last;
    buffer->block = RG_NONE;
    buffer->max_size = r->max_size;
    if (r->usage & structure && (r->import == RG_NONE || r->usage != structure))
        rg_fault_of(c, RG_ERROR_ACCESS, r->name,
                    "import the acceleration structure; its buffer holds nothing else");
    if (buffer->imported || r->buffer->memory != RG_MEMORY_DEVICE)
        return;
    struct rg_memory_requirements required = buffer_memory(c, buffer->size, buffer->usage);
    if (r->max_size != r->size) {
        const struct rg_memory_requirements most = buffer_memory(c, r->max_size, buffer->usage);
        required = combine_requirements(required, &most);
    }
    buffer->memory_size = required.size;
    add_memory(c, r, &required);
}

void rg_list_resources(struct compiler *c)
{
    struct rg_plan *plan = c->plan;
    plan->images = c->images = ARENA_ARRAY(c->arena, struct rg_plan_image, plan->image_count);
    plan->buffers = c->buffers = ARENA_ZEROED(c->arena, struct rg_plan_buffer, plan->buffer_count);
    c->items = ARENA_ARRAY(c->arena, struct pack_item, c->item_count);
    for (uint32_t i = 0; i < c->resource_count && !c->arena->failed; i++) {
        struct resource *r = c->resources[i];
        if (r->first == RG_NONE)
            continue;
        if (r->image)
            list_image(c, r);
        else
            list_buffer(c, r);
    }
}
