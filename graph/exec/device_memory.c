/* device_memory.c: allocates memory blocks, and creates the images and buffers of a plan. */
#include <string.h>
#include "graph/exec/executor_internal.h"

uint32_t rg_exec_families(const struct rg_exec *exec, uint32_t queues,
                          uint32_t families[RG_QUEUE_COUNT])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++) {
        const uint32_t family = rg_exec_queue_of(exec, i).family;
        bool known = !(queues >> i & 1) || (i != RG_QUEUE_MAIN && !rg_exec_queue_of(exec, i).queue);
        for (uint32_t k = 0; k < count; k++)
            known = known || families[k] == family;
        if (!known)
            families[count++] = family;
    }
    return count;
}

/* Returns the first memory type with `needed` and preferably `preferred` properties, or RG_NONE. */
static uint32_t find_type(const struct rg_exec *exec, uint32_t bits,
                          VkMemoryPropertyFlags preferred, VkMemoryPropertyFlags needed)
{
    const VkPhysicalDeviceMemoryProperties *p = &exec->memory_properties;
    const VkMemoryPropertyFlags choices[] = { preferred | needed, needed };
    for (size_t c = 0; c < 2; c++) {
        for (uint32_t i = 0; i < p->memoryTypeCount; i++) {
            if ((bits & 1u << i) && !(choices[c] & ~p->memoryTypes[i].propertyFlags))
                return i;
        }
    }
    return RG_NONE;
}

/* Begins the cache key of an object that is identified by its name. */
static void add_name(struct rg_exec *exec, const char *name, uint64_t salt)
{
    rg_exec_key(exec, name, strlen(name) + 1);
    RG_KEY(exec, salt);
}

static VkResult allocate(struct rg_exec *exec, VkDeviceSize size, uint32_t type, const char *name,
                         uint64_t salt, VkDeviceMemory *memory)
{
    VkResult result;
    if (type == RG_NONE)
        return rg_exec_check(exec, VK_ERROR_FEATURE_NOT_PRESENT, "the memory type", name);
    add_name(exec, name, salt);
    RG_KEY(exec, size);
    RG_KEY(exec, type);
    RG_MAKE(exec, name, DEVICE_MEMORY, AllocateMemory, memory,
            &(VkMemoryAllocateInfo){
                .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                .allocationSize = size,
                .memoryTypeIndex = type,
            });
fail:
    return result;
}

static VkResult allocate_local(struct rg_exec *exec, VkDeviceSize size, uint32_t type_bits,
                               const char *name, uint64_t salt, VkDeviceMemory *memory)
{
    uint32_t type = find_type(exec, type_bits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0);
    return allocate(exec, size, type, name, salt, memory);
}

static VkResult make_blocks(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < exec->plan->block_count && result == VK_SUCCESS; i++) {
        const struct rg_block *block = &exec->plan->blocks[i];
        const char *name = block->buffers ? "transient buffers" : "transient images";
        result = allocate_local(exec, block->size, block->type_bits, name, 0, &exec->blocks[i]);
    }
    return result;
}

/* Location of a resource in memory, according to the plan. */
struct placement {
    const char *name; /* of the resource */
    uint32_t block;   /* RG_NONE: dedicated memory */
    VkDeviceSize offset, size;
    uint64_t salt; /* distinguishes keys of equal names */
};

/* Finds or allocates a resource's memory. If the plan's memory does not suit the resource, fails.
 * This happens only if the plan was compiled for another device. */
static VkResult find_memory(struct rg_exec *exec, const struct placement *placement,
                            const VkMemoryRequirements *needs, VkDeviceMemory *memory)
{
    VkDeviceSize size = needs->size > placement->size ? needs->size : placement->size;
    if (placement->block == RG_NONE)
        return allocate_local(exec, size, needs->memoryTypeBits, placement->name, placement->salt,
                              memory);
    const struct rg_block *block = &exec->plan->blocks[placement->block];
    *memory = exec->blocks[placement->block];
    if (needs->size > placement->size || placement->offset % needs->alignment ||
        block->type_bits & ~needs->memoryTypeBits)
        return rg_exec_check(exec, VK_ERROR_INCOMPATIBLE_DRIVER,
                             "a plan for another device: the memory", placement->name);
    return VK_SUCCESS;
}

/* Returns the program's object for an imported resource; logs and returns NULL if it is missing. */
static const struct rg_exec_import *find_import(const struct rg_exec *exec, uint32_t import,
                                                const char *name)
{
    if (import < exec->params.import_count)
        return &exec->params.imports[import];
    rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, "the imported object", name);
    return NULL;
}

VkImageSubresourceRange rg_exec_full_range(const struct rg_plan_image *image)
{
    return (VkImageSubresourceRange){ image->aspects, 0, image->mips, 0, image->layers };
}

/* Stores the cache key of an image, which includes the memory that it is bound to. */
static void add_image(struct rg_exec *exec, const struct rg_plan_image *plan,
                      const struct rg_use *placeholder)
{
    const uint32_t fields[] = { plan->flags,        (uint32_t)plan->image->format,
                                plan->extent.width, plan->extent.height,
                                plan->depth,        plan->layers,
                                plan->mips,         plan->samples,
                                plan->usage,        plan->queues };
    add_name(exec, plan->image->name, placeholder != NULL);
    if (plan->partner != RG_NONE) /* an update keeps both partners or neither */
        add_name(exec, exec->plan->images[plan->partner].image->name, plan->partner != RG_NONE);
    if (placeholder) {
        rg_exec_key(exec, placeholder->fallback, sizeof(*placeholder->fallback));
        RG_KEY(exec, placeholder->range.aspect);
    }
    rg_exec_key(exec, fields, sizeof(fields));
    RG_KEY(exec, plan->size);
    RG_KEY(exec, plan->block == RG_NONE ? VK_NULL_HANDLE : exec->blocks[plan->block]);
    RG_KEY(exec, plan->offset);
}

VkResult rg_exec_make_image(struct rg_exec *exec, const struct rg_plan_image *plan,
                            const struct rg_use *placeholder, VkImage *image)
{
    const struct placement placement = { plan->image->name, plan->block, plan->offset, plan->size,
                                         placeholder != NULL };
    uint32_t families[RG_QUEUE_COUNT];
    VkImageCreateInfo info = rg_image_create_info(plan);
    VkMemoryRequirements needs;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkResult result;
    info.queueFamilyIndexCount = rg_exec_families(exec, plan->queues, families);
    info.pQueueFamilyIndices = families;
    info.sharingMode =
        info.queueFamilyIndexCount > 1 ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE;
    add_image(exec, plan, placeholder);
    RG_MAKE(exec, placement.name, IMAGE, CreateImage, image, &info);
    if (exec->found == RG_FOUND_HERE)
        return VK_SUCCESS;
    const bool is_bound = exec->found;
    if (is_bound && plan->block != RG_NONE)
        return VK_SUCCESS;
    exec->vk.GetImageMemoryRequirements(exec->device, *image, &needs);
    RG_TRY(find_memory(exec, &placement, &needs, &memory));
    if (!is_bound)
        RG_CALL(exec, placement.name, BindImageMemory, exec->device, *image, memory,
                placement.offset);
    exec->found = is_bound ? RG_FOUND_FORMER : RG_NOT_FOUND;
fail:
    return result;
}

VkResult rg_exec_make_view(struct rg_exec *exec, const struct rg_plan_image *plan, VkImage image,
                           const struct exec_view *info, VkImageView *view)
{
    const bool is_mutable = plan->flags & VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
    /* other formats may not support all usage flags of the image */
    const VkImageViewUsageCreateInfo usage = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO,
        .usage = info->usage,
    };
    struct exec_view key = *info;
    VkResult result;
    key.usage = is_mutable ? info->usage : 0; /* other views are shared by uses of all kinds */
    if (!plan->imported) {
        rg_exec_key(exec, &key, sizeof(key));
        RG_KEY(exec, image);
    }
    RG_MAKE(exec, plan->image->name, IMAGE_VIEW, CreateImageView, view,
            &(VkImageViewCreateInfo){
                .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                .pNext = is_mutable ? &usage : NULL,
                .image = image,
                .viewType = info->type,
                .format = info->format ? info->format : plan->image->format,
                .subresourceRange = info->range,
            });
fail:
    return result;
}

/* Sets *origin to 1 plus the index that a persistent resource had in the previous plan, or to 0. */
static VkResult find_origin(struct rg_exec *exec, uint64_t handle, uint32_t index, uint32_t *origin)
{
    uint32_t *last; /* index plus 1, kept with the resource */
    RG_KEY(exec, RG_ARRAY_INDEX);
    RG_KEY(exec, handle);
    if (!RG_MAKE_ARRAY(exec, last, 1))
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    *origin = *last;
    *last = index + 1;
    return VK_SUCCESS;
}

/* Finds or creates an image of the plan and stores it in every image set. */
static VkResult find_images(struct rg_exec *exec, uint32_t index)
{
    const struct rg_plan_image *plan = &exec->plan->images[index];
    const struct rg_exec_import own = { 0 };
    const struct rg_exec_import *import = &own;
    VkImage image = VK_NULL_HANDLE;
    VkResult result = VK_SUCCESS;
    if (plan->imported)
        import = find_import(exec, plan->import, plan->image->name);
    else
        result = rg_exec_make_image(exec, plan, NULL, &image);
    if (!import)
        return VK_ERROR_INITIALIZATION_FAILED;
    if (image && plan->persistent && result == VK_SUCCESS)
        result = find_origin(exec, (uint64_t)image, index, &exec->origins[index]);
    for (uint32_t i = 0; i < exec->image_set_count; i++)
        exec->image_sets[i].images[index] = import->image_count ? import->images[i / exec->parities]
                                            : image             ? image
                                                                : import->image;
    return result;
}

VkResult rg_exec_make_host_buffer(struct rg_exec *exec, const VkBufferCreateInfo *info,
                                  VkMemoryPropertyFlags preferred, const char *name, uint32_t slot,
                                  struct exec_buffer *buffer)
{
    VkMemoryRequirements needs;
    struct exec_buffer *known;
    VkResult result;
    RG_KEY(exec, RG_ARRAY_HOST_BUFFER);
    add_name(exec, name, slot);
    RG_KEY(exec, info->size);
    RG_KEY(exec, info->usage);
    RG_KEY(exec, info->queueFamilyIndexCount);
    RG_KEY(exec, preferred);
    if (!RG_MAKE_ARRAY(exec, known, 1))
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    *buffer = *known;
    RG_KEY(exec, known); /* which is freed with the buffer and its memory */
    RG_MAKE(exec, name, BUFFER, CreateBuffer, &buffer->buffer, info);
    exec->vk.GetBufferMemoryRequirements(exec->device, buffer->buffer, &needs);
    uint32_t type =
        find_type(exec, needs.memoryTypeBits, preferred, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT);
    RG_TRY(allocate(exec, needs.size, type, name, (uintptr_t)known, &buffer->host));
    if (known->mapped)
        return VK_SUCCESS;
    buffer->coherent = exec->memory_properties.memoryTypes[type].propertyFlags &
                       VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    RG_CALL(exec, name, BindBufferMemory, exec->device, buffer->buffer, buffer->host, 0);
    RG_CALL(exec, name, MapMemory, exec->device, buffer->host, 0, VK_WHOLE_SIZE, 0,
            &buffer->mapped); /* unmapped when the memory is freed */
    *known = *buffer;
fail:
    return result;
}

static VkResult make_device_buffer(struct rg_exec *exec, const VkBufferCreateInfo *info,
                                   const struct placement *placement, VkBuffer *buffer)
{
    VkMemoryRequirements needs;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkResult result;
    add_name(exec, placement->name, info->usage);
    RG_KEY(exec, info->size);
    RG_KEY(exec, info->queueFamilyIndexCount);
    RG_KEY(exec, placement->size);
    RG_KEY(exec, placement->block == RG_NONE ? VK_NULL_HANDLE : exec->blocks[placement->block]);
    RG_KEY(exec, placement->offset);
    RG_MAKE(exec, placement->name, BUFFER, CreateBuffer, buffer, info);
    const bool is_bound = exec->found;
    if (is_bound && placement->block != RG_NONE)
        return VK_SUCCESS;
    exec->vk.GetBufferMemoryRequirements(exec->device, *buffer, &needs);
    RG_TRY(find_memory(exec, placement, &needs, &memory));
    if (!is_bound)
        RG_CALL(exec, placement->name, BindBufferMemory, exec->device, *buffer, memory,
                placement->offset);
fail:
    return result;
}

/* Finds or creates a buffer of the plan for every frame slot. */
static VkResult find_buffers(struct rg_exec *exec, uint32_t index)
{
    const struct rg_plan_buffer *plan = &exec->plan->buffers[index];
    const struct placement placement = { plan->buffer->name, plan->block, plan->offset,
                                         plan->memory_size, 0 };
    bool is_host = !plan->imported && plan->buffer->memory != RG_MEMORY_DEVICE;
    uint32_t families[RG_QUEUE_COUNT];
    const uint32_t family_count = rg_exec_families(exec, plan->queues, families);
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .sharingMode = family_count > 1 ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE,
        .queueFamilyIndexCount = family_count,
        .pQueueFamilyIndices = families,
        /* vkCmdFillBuffer() writes multiples of 4 bytes */
        .size = is_host            ? plan->max_size
                : plan->persistent ? (plan->size + 3) / 4 * 4
                                   : plan->size,
        .usage = plan->usage,
    };
    VkMemoryPropertyFlags preferred = plan->buffer->memory == RG_MEMORY_READBACK
                                          ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                          : VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkResult result = VK_SUCCESS;
    for (uint32_t slot = 0; slot < exec->slot_count && result == VK_SUCCESS; slot++) {
        struct exec_buffer *buffer = rg_exec_buffer(exec, index, slot);
        const struct rg_exec_import *import;
        if (is_host) {
            result = rg_exec_make_host_buffer(exec, &info, preferred, placement.name, slot, buffer);
        } else if (slot > 0) {
            *buffer = *rg_exec_buffer(exec, index, 0);
        } else if (!plan->imported) {
            result = make_device_buffer(exec, &info, &placement, &buffer->buffer);
            if (plan->persistent && result == VK_SUCCESS)
                result = find_origin(exec, (uint64_t)buffer->buffer, index,
                                     &exec->origins[exec->plan->image_count + index]);
        } else {
            import = find_import(exec, plan->import, placement.name);
            buffer->buffer = import ? import->buffer : VK_NULL_HANDLE;
            buffer->acceleration = import ? import->acceleration : VK_NULL_HANDLE;
            result = import ? VK_SUCCESS : VK_ERROR_INITIALIZATION_FAILED;
        }
    }
    return result;
}

/* Swaps the images that have a partner in the image sets of odd frames. */
static void swap_partners(struct rg_exec *exec)
{
    for (uint32_t i = 0; i < exec->plan->image_count; i++) {
        const uint32_t partner = exec->plan->images[i].partner;
        for (uint32_t s = 1; s < exec->image_set_count && partner < i; s += 2) {
            VkImage *images = exec->image_sets[s].images;
            VkImage image = images[i];
            images[i] = images[partner];
            images[partner] = image;
        }
    }
}

VkResult rg_exec_make_memory(struct rg_exec *exec)
{
    VkResult result = make_blocks(exec);
    for (uint32_t i = 0; i < exec->plan->image_count && result == VK_SUCCESS; i++)
        result = find_images(exec, i);
    if (exec->parities > 1)
        swap_partners(exec);
    for (uint32_t i = 0; i < exec->plan->buffer_count && result == VK_SUCCESS; i++)
        result = find_buffers(exec, i);
    return result;
}

VkDeviceMemory rg_exec_block(const struct rg_exec *exec, uint32_t block)
{
    return exec->blocks[block];
}

struct exec_buffer *rg_exec_buffer(const struct rg_exec *exec, uint32_t buffer, uint32_t slot)
{
    return &exec->buffers[(size_t)slot * exec->plan->buffer_count + buffer];
}

/* Flushes a slot's upload buffers or invalidates its readback buffers. Skips coherent memory. */
VkResult rg_exec_sync_host(struct rg_exec *exec, uint32_t slot, enum rg_memory memory)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < exec->plan->buffer_count; i++) {
        const struct rg_buffer *declared = exec->plan->buffers[i].buffer;
        const struct exec_buffer *buffer = rg_exec_buffer(exec, i, slot);
        const VkMappedMemoryRange range = {
            .sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE,
            .memory = buffer->host,
            .size = VK_WHOLE_SIZE,
        };
        if (!buffer->host || buffer->coherent || declared->memory != memory)
            continue;
        if (memory == RG_MEMORY_UPLOAD)
            RG_CALL(exec, declared->name, FlushMappedMemoryRanges, exec->device, 1, &range);
        else
            RG_CALL(exec, declared->name, InvalidateMappedMemoryRanges, exec->device, 1, &range);
    }
fail:
    return result;
}
