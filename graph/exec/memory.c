/* memory.c: blocks of device memory, the images and buffers in them, and host buffers. */
#include <stdlib.h>
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

static VkResult allocate(const struct rg_exec *exec, VkDeviceSize size, uint32_t type,
                         const char *name, VkDeviceMemory *memory)
{
    VkResult result;
    if (type == RG_NONE)
        return rg_exec_check(exec, VK_ERROR_FEATURE_NOT_PRESENT, "the memory type", name);
    RG_MAKE(exec, name, AllocateMemory, memory,
            &(VkMemoryAllocateInfo){
                .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                .allocationSize = size,
                .memoryTypeIndex = type,
            });
fail:
    return result;
}

VkResult rg_exec_allocate(const struct rg_exec *exec, const VkMemoryRequirements *needs,
                          VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags needed,
                          const char *name, VkDeviceMemory *memory)
{
    uint32_t type = find_type(exec, needs->memoryTypeBits, wanted, needed);
    VkResult result;
    RG_PASS(allocate(exec, needs->size, type, name, memory));
    rg_exec_name(exec, VK_OBJECT_TYPE_DEVICE_MEMORY, (uint64_t)*memory, name);
fail:
    return result;
}

static VkResult allocate_local(const struct rg_exec *exec, const VkMemoryRequirements *needs,
                               const char *name, VkDeviceMemory *memory)
{
    return rg_exec_allocate(exec, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, name, memory);
}

/* An executor made with `warm_up_only` makes the objects that others import. */
static bool is_foreign(const struct rg_exec *exec, bool imported)
{
    return imported && !exec->params.warm_up_only;
}

static VkResult make_blocks(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < exec->plan->block_count && result == VK_SUCCESS; i++) {
        const struct rg_block *block = &exec->plan->blocks[i];
        const VkMemoryRequirements needs = { block->size, block->alignment, block->type_bits };
        result =
            allocate_local(exec, &needs, block->buffers ? "transient buffers" : "transient images",
                           &exec->blocks[i]);
    }
    return result;
}

static const char for_another[] = "a plan for another device: the place";

/* Checks the place that the plan gives a resource: a plan that was compiled without this device, or
 * for another one, may have given it too little memory. */
static bool fits(const VkMemoryRequirements *needs, const struct rg_block *block,
                 VkDeviceSize offset, VkDeviceSize size)
{
    return needs->size <= size && offset % needs->alignment == 0 &&
           !(block->type_bits & ~needs->memoryTypeBits);
}

static VkResult make_image(struct rg_exec *exec, uint32_t index)
{
    const struct rg_plan_image *image = &exec->plan->images[index];
    const char *name = image->image->name;
    const VkImageCreateInfo info = rg_image_create_info(image);
    VkMemoryRequirements needs;
    VkResult result = VK_SUCCESS;
    if (is_foreign(exec, image->imported)) {
        if (image->import >= exec->params.import_count)
            RG_PASS(rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, "the object", name));
        exec->images[index] = exec->params.imports[image->import].image;
        rg_exec_keep_import_images(exec, index, &exec->params.imports[image->import]);
        return VK_SUCCESS;
    }
    RG_MAKE(exec, name, CreateImage, &exec->images[index], &info);
    rg_exec_name(exec, VK_OBJECT_TYPE_IMAGE, (uint64_t)exec->images[index], name);
    exec->vk.GetImageMemoryRequirements(exec->device, exec->images[index], &needs);
    if (image->persistent || image->imported) {
        VkDeviceMemory *memory = &exec->image_memory[index];
        RG_PASS(allocate_local(exec, &needs, name, memory));
        RG_CALL(exec, name, BindImageMemory, exec->device, exec->images[index], *memory, 0);
        return VK_SUCCESS;
    }
    if (!fits(&needs, &exec->plan->blocks[image->block], image->offset, image->size))
        RG_PASS(rg_exec_check(exec, VK_ERROR_INCOMPATIBLE_DRIVER, for_another, name));
    RG_CALL(exec, name, BindImageMemory, exec->device, exec->images[index],
            exec->blocks[image->block], image->offset);
fail:
    return result;
}

static VkResult create_buffer(struct rg_exec *exec, const struct rg_plan_buffer *plan,
                              VkBuffer *buffer)
{
    /* vkCmdFillBuffer() fills whole words of 4 bytes */
    VkDeviceSize room = plan->persistent ? (plan->size + 3) / 4 * 4 : plan->size;
    VkResult result;
    RG_MAKE(exec, plan->buffer->name, CreateBuffer, buffer,
            &(VkBufferCreateInfo){
                .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                .size = room,
                .usage = plan->usage,
            });
    rg_exec_name(exec, VK_OBJECT_TYPE_BUFFER, (uint64_t)*buffer, plan->buffer->name);
fail:
    return result;
}

static VkResult make_device_buffer(struct rg_exec *exec, const struct rg_plan_buffer *plan,
                                   struct exec_buffer *buffer)
{
    const char *name = plan->buffer->name;
    VkMemoryRequirements needs;
    VkResult result;
    RG_PASS(create_buffer(exec, plan, &buffer->buffers[0]));
    exec->vk.GetBufferMemoryRequirements(exec->device, buffer->buffers[0], &needs);
    if (plan->persistent || plan->imported) {
        RG_PASS(allocate_local(exec, &needs, name, &buffer->own));
        RG_CALL(exec, name, BindBufferMemory, exec->device, buffer->buffers[0], buffer->own, 0);
        return VK_SUCCESS;
    }
    if (!fits(&needs, &exec->plan->blocks[plan->block], plan->offset, plan->memory_size))
        RG_PASS(rg_exec_check(exec, VK_ERROR_INCOMPATIBLE_DRIVER, for_another, name));
    RG_CALL(exec, name, BindBufferMemory, exec->device, buffer->buffers[0],
            exec->blocks[plan->block], plan->offset);
fail:
    return result;
}

static VkResult make_host_buffer(struct rg_exec *exec, const struct rg_plan_buffer *plan,
                                 struct exec_buffer *buffer, uint32_t slot)
{
    const char *name = plan->buffer->name;
    VkMemoryRequirements needs;
    VkResult result;
    VkMemoryPropertyFlags wanted = plan->buffer->memory == RG_MEMORY_READBACK
                                       ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                       : VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    RG_PASS(create_buffer(exec, plan, &buffer->buffers[slot]));
    exec->vk.GetBufferMemoryRequirements(exec->device, buffer->buffers[slot], &needs);
    uint32_t type =
        find_type(exec, needs.memoryTypeBits, wanted, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT);
    RG_PASS(allocate(exec, needs.size, type, name, &buffer->memory[slot]));
    buffer->coherent = exec->memory_properties.memoryTypes[type].propertyFlags &
                       VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    RG_CALL(exec, name, BindBufferMemory, exec->device, buffer->buffers[slot], buffer->memory[slot],
            0);
    RG_CALL(exec, name, MapMemory, exec->device, buffer->memory[slot], 0, VK_WHOLE_SIZE, 0,
            &buffer->mapped[slot]);
fail:
    return result;
}

static VkResult make_buffer(struct rg_exec *exec, uint32_t index)
{
    const struct rg_plan_buffer *plan = &exec->plan->buffers[index];
    struct exec_buffer *buffer = &exec->buffers[index];
    bool host = !plan->imported && plan->buffer->memory != RG_MEMORY_DEVICE;
    VkResult result = VK_ERROR_OUT_OF_HOST_MEMORY;
    buffer->buffers = calloc(exec->slot_count, sizeof(VkBuffer));
    if (host) {
        buffer->memory = calloc(exec->slot_count, sizeof(VkDeviceMemory));
        buffer->mapped = calloc(exec->slot_count, sizeof(*buffer->mapped));
    }
    if (!buffer->buffers || (host && (!buffer->memory || !buffer->mapped)))
        return rg_exec_check(exec, result, "calloc", plan->buffer->name);
    if (is_foreign(exec, plan->imported)) {
        if (plan->import >= exec->params.import_count)
            RG_PASS(rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, "the object",
                                  plan->buffer->name));
        buffer->buffers[0] = exec->params.imports[plan->import].buffer;
        return VK_SUCCESS;
    }
    if (!host)
        return make_device_buffer(exec, plan, buffer);
    for (uint32_t slot = 0; slot < exec->slot_count; slot++) {
        result = make_host_buffer(exec, plan, buffer, slot);
        if (result != VK_SUCCESS)
            break;
    }
fail:
    return result;
}

VkResult rg_exec_make_memory(struct rg_exec *exec)
{
    VkResult result = make_blocks(exec);
    for (uint32_t i = 0; i < exec->plan->image_count && result == VK_SUCCESS; i++)
        result = make_image(exec, i);
    for (uint32_t i = 0; i < exec->plan->buffer_count && result == VK_SUCCESS; i++)
        result = make_buffer(exec, i);
    return result;
}

void rg_exec_free_memory(struct rg_exec *exec)
{
    const struct rg_plan *plan = exec->plan;
    for (uint32_t i = 0; exec->images && i < plan->image_count; i++) {
        if (!is_foreign(exec, plan->images[i].imported))
            exec->vk.DestroyImage(exec->device, exec->images[i], NULL);
    }
    for (uint32_t i = 0; exec->image_memory && i < plan->image_count; i++)
        exec->vk.FreeMemory(exec->device, exec->image_memory[i], NULL);
    for (uint32_t i = 0; exec->buffers && i < plan->buffer_count; i++) {
        struct exec_buffer *buffer = &exec->buffers[i];
        for (uint32_t slot = 0; slot < exec->slot_count; slot++) {
            if (buffer->buffers && !is_foreign(exec, plan->buffers[i].imported))
                exec->vk.DestroyBuffer(exec->device, buffer->buffers[slot], NULL);
            if (buffer->memory)
                exec->vk.FreeMemory(exec->device, buffer->memory[slot], NULL);
        }
        exec->vk.FreeMemory(exec->device, buffer->own, NULL);
        free(buffer->buffers);
        free(buffer->memory);
        free(buffer->mapped);
    }
    for (uint32_t i = 0; exec->blocks && i < plan->block_count; i++)
        exec->vk.FreeMemory(exec->device, exec->blocks[i], NULL);
}

VkDeviceMemory rg_exec_block(const struct rg_exec *exec, uint32_t block)
{
    return exec->blocks[block];
}

VkBuffer rg_exec_buffer(const struct rg_exec *exec, uint32_t buffer, uint32_t slot)
{
    const struct exec_buffer *b = &exec->buffers[buffer];
    return b->buffers[b->memory ? slot : 0];
}

/* Flushes what the CPU wrote, or invalidates what it will read; coherent memory needs neither. */
VkResult rg_exec_sync_host(struct rg_exec *exec, uint32_t slot, enum rg_memory memory)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < exec->plan->buffer_count; i++) {
        const struct exec_buffer *buffer = &exec->buffers[i];
        if (!buffer->memory || buffer->coherent || exec->plan->buffers[i].buffer->memory != memory)
            continue;
        const VkMappedMemoryRange range = {
            .sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE,
            .memory = buffer->memory[slot],
            .size = VK_WHOLE_SIZE,
        };
        const char *name = exec->plan->buffers[i].buffer->name;
        if (memory == RG_MEMORY_UPLOAD)
            RG_CALL(exec, name, FlushMappedMemoryRanges, exec->device, 1, &range);
        else
            RG_CALL(exec, name, InvalidateMappedMemoryRanges, exec->device, 1, &range);
    }
fail:
    return result;
}
