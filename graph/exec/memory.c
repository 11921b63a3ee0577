/* memory.c: blocks of device memory, the images and buffers in them, and host buffers. */
#include "graph/exec/exec.h"

/* Returns the first memory type that has all of `wanted` and `needed`, else of `needed`; RG_NONE if
 * there is none. */
static uint32_t find_type(const struct rg_exec *exec, uint32_t bits, VkMemoryPropertyFlags wanted,
                          VkMemoryPropertyFlags needed)
{
    const VkPhysicalDeviceMemoryProperties *p = &exec->memory_properties;
    const VkMemoryPropertyFlags choices[] = { wanted | needed, needed };
    for (size_t c = 0; c < 2; c++) {
        for (uint32_t i = 0; i < p->memoryTypeCount; i++) {
            if ((bits & 1u << i) && !(choices[c] & ~p->memoryTypes[i].propertyFlags))
                return i;
        }
    }
    return RG_NONE;
}

static VkResult allocate(struct rg_exec *exec, VkDeviceSize size, uint32_t type, const char *name,
                         VkDeviceMemory *memory)
{
    VkResult result;
    if (type == RG_NONE)
        return rg_exec_check(exec, VK_ERROR_FEATURE_NOT_PRESENT, "the memory type", name);
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
                               const char *name, VkDeviceMemory *memory)
{
    uint32_t type = find_type(exec, type_bits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0);
    return allocate(exec, size, type, name, memory);
}

static VkResult make_blocks(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < exec->plan->block_count && result == VK_SUCCESS; i++) {
        const struct rg_block *block = &exec->plan->blocks[i];
        const char *name = block->buffers ? "transient buffers" : "transient images";
        result = allocate_local(exec, block->size, block->type_bits, name, &exec->blocks[i]);
    }
    return result;
}

/* Where the plan puts a resource. */
struct place {
    const char *name; /* of the resource */
    uint32_t block;   /* RG_NONE: memory of its own */
    VkDeviceSize offset, size;
};

/* Finds the memory of a place. A plan that was compiled without this device, or for another one,
 * may have given the resource too little. */
static VkResult find_memory(struct rg_exec *exec, const struct place *place,
                            const VkMemoryRequirements *needs, VkDeviceMemory *memory)
{
    if (place->block == RG_NONE)
        return allocate_local(exec, needs->size, needs->memoryTypeBits, place->name, memory);
    const struct rg_block *block = &exec->plan->blocks[place->block];
    *memory = exec->blocks[place->block];
    if (needs->size > place->size || place->offset % needs->alignment ||
        block->type_bits & ~needs->memoryTypeBits)
        return rg_exec_check(exec, VK_ERROR_INCOMPATIBLE_DRIVER,
                             "a plan for another device: the place", place->name);
    return VK_SUCCESS;
}

/* Returns the import of a plan's resource; NULL if the program has given none. */
static const struct rg_exec_import *find_import(const struct rg_exec *exec, uint32_t import,
                                                const char *name)
{
    if (import < exec->params.import_count)
        return &exec->params.imports[import];
    rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, "the object", name);
    return NULL;
}

/* An executor made with `warm_up_only` makes the objects that others import. */
static bool is_foreign(const struct rg_exec *exec, bool imported)
{
    return imported && !exec->params.warm_up_only;
}

/* ---- images ---- */

VkImageSubresourceRange rg_exec_whole(const struct rg_plan_image *image)
{
    return (VkImageSubresourceRange){ image->aspects, 0, image->mips, 0, image->layers };
}

VkResult rg_exec_make_image(struct rg_exec *exec, const struct rg_plan_image *plan, VkImage *image)
{
    const struct place place = { plan->image->name, plan->block, plan->offset, plan->size };
    const VkImageCreateInfo info = rg_image_create_info(plan);
    VkMemoryRequirements needs;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkResult result;
    RG_MAKE(exec, place.name, IMAGE, CreateImage, image, &info);
    exec->vk.GetImageMemoryRequirements(exec->device, *image, &needs);
    RG_PASS(find_memory(exec, &place, &needs, &memory));
    RG_CALL(exec, place.name, BindImageMemory, exec->device, *image, memory, place.offset);
fail:
    return result;
}

VkResult rg_exec_make_view(struct rg_exec *exec, const struct rg_plan_image *plan, VkImage image,
                           VkImageViewType type, const VkImageSubresourceRange *range,
                           VkImageView *view)
{
    VkResult result;
    RG_MAKE(exec, plan->image->name, IMAGE_VIEW, CreateImageView, view,
            &(VkImageViewCreateInfo){
                .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                .image = image,
                .viewType = type,
                .format = plan->image->format,
                .subresourceRange = *range,
            });
fail:
    return result;
}

/* Fills the image of every image set. */
static VkResult find_images(struct rg_exec *exec, uint32_t index)
{
    const struct rg_plan_image *plan = &exec->plan->images[index];
    const struct rg_exec_import own = { 0 };
    const struct rg_exec_import *import = &own;
    VkImage image = VK_NULL_HANDLE;
    VkResult result = VK_SUCCESS;
    if (is_foreign(exec, plan->imported))
        import = find_import(exec, plan->import, plan->image->name);
    else
        result = rg_exec_make_image(exec, plan, &image);
    if (!import)
        return VK_ERROR_INITIALIZATION_FAILED;
    for (uint32_t i = 0; i < exec->image_set_count; i++)
        exec->image_sets[i].images[index] = import->image_count ? import->images[i]
                                            : image             ? image
                                                                : import->image;
    return result;
}

/* ---- buffers ---- */

VkResult rg_exec_make_host_buffer(struct rg_exec *exec, const VkBufferCreateInfo *info,
                                  VkMemoryPropertyFlags wanted, const char *name,
                                  struct exec_buffer *buffer)
{
    VkMemoryRequirements needs;
    VkResult result;
    RG_MAKE(exec, name, BUFFER, CreateBuffer, &buffer->buffer, info);
    exec->vk.GetBufferMemoryRequirements(exec->device, buffer->buffer, &needs);
    uint32_t type =
        find_type(exec, needs.memoryTypeBits, wanted, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT);
    RG_PASS(allocate(exec, needs.size, type, name, &buffer->host));
    buffer->coherent = exec->memory_properties.memoryTypes[type].propertyFlags &
                       VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    RG_CALL(exec, name, BindBufferMemory, exec->device, buffer->buffer, buffer->host, 0);
    RG_CALL(exec, name, MapMemory, exec->device, buffer->host, 0, VK_WHOLE_SIZE, 0,
            &buffer->mapped); /* freeing the memory unmaps it */
fail:
    return result;
}

static VkResult make_device_buffer(struct rg_exec *exec, const VkBufferCreateInfo *info,
                                   const struct place *place, VkBuffer *buffer)
{
    VkMemoryRequirements needs;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkResult result;
    RG_MAKE(exec, place->name, BUFFER, CreateBuffer, buffer, info);
    exec->vk.GetBufferMemoryRequirements(exec->device, *buffer, &needs);
    RG_PASS(find_memory(exec, place, &needs, &memory));
    RG_CALL(exec, place->name, BindBufferMemory, exec->device, *buffer, memory, place->offset);
fail:
    return result;
}

/* Fills the buffer of every slot. */
static VkResult find_buffers(struct rg_exec *exec, uint32_t index)
{
    const struct rg_plan_buffer *plan = &exec->plan->buffers[index];
    const struct place place = { plan->buffer->name, plan->block, plan->offset, plan->memory_size };
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        /* vkCmdFillBuffer() fills whole words of 4 bytes */
        .size = plan->persistent ? (plan->size + 3) / 4 * 4 : plan->size,
        .usage = plan->usage,
    };
    VkMemoryPropertyFlags wanted = plan->buffer->memory == RG_MEMORY_READBACK
                                       ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                       : VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    bool is_host = !plan->imported && plan->buffer->memory != RG_MEMORY_DEVICE;
    VkResult result = VK_SUCCESS;
    for (uint32_t slot = 0; slot < exec->slot_count && result == VK_SUCCESS; slot++) {
        struct exec_buffer *buffer = rg_exec_buffer(exec, index, slot);
        const struct rg_exec_import *import;
        if (is_host) {
            result = rg_exec_make_host_buffer(exec, &info, wanted, place.name, buffer);
        } else if (slot > 0) {
            *buffer = *rg_exec_buffer(exec, index, 0);
        } else if (!is_foreign(exec, plan->imported)) {
            result = make_device_buffer(exec, &info, &place, &buffer->buffer);
        } else {
            import = find_import(exec, plan->import, place.name);
            buffer->buffer = import ? import->buffer : VK_NULL_HANDLE;
            result = import ? VK_SUCCESS : VK_ERROR_INITIALIZATION_FAILED;
        }
    }
    return result;
}

VkResult rg_exec_make_memory(struct rg_exec *exec)
{
    VkResult result = make_blocks(exec);
    for (uint32_t i = 0; i < exec->plan->image_count && result == VK_SUCCESS; i++)
        result = find_images(exec, i);
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

/* Flushes what the CPU wrote, or invalidates what it will read; coherent memory needs neither. */
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
