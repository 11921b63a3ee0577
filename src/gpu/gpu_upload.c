/* gpu_upload.c: a staging buffer and the commands that copy from it. */
#include "src/gpu/gpu_internal.h"

static VkResult begin_commands(VkCommandBuffer commands)
{
    const VkCommandBufferBeginInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    return vkBeginCommandBuffer(commands, &info);
}

enum status gpu_upload_begin(struct gpu *gpu, struct gpu_upload *upload, VkDeviceSize size,
                             const char *name)
{
    const VkFenceCreateInfo fence = { .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO };
    const VkCommandBufferAllocateInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = gpu->pool,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1,
    };
    *upload = (struct gpu_upload){ .name = name };
    const enum status status =
        gpu_memory_buffer(gpu, &upload->staging, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          size < GPU_STAGING_SIZE ? size : GPU_STAGING_SIZE, true, "staging");
    if (status != STATUS_OK)
        return status;
    VkResult result =
        vkMapMemory(gpu->device, upload->staging.memory, 0, VK_WHOLE_SIZE, 0, &upload->mapped);
    if (result != VK_SUCCESS)
        return gpu_failed_for("vkMapMemory", name, result);
    result = vkCreateFence(gpu->device, &fence, NULL, &upload->fence);
    if (result != VK_SUCCESS) {
        upload->fence = VK_NULL_HANDLE;
        return gpu_failed_for("vkCreateFence", name, result);
    }
    result = vkAllocateCommandBuffers(gpu->device, &commands, &upload->commands);
    if (result != VK_SUCCESS) {
        upload->commands = VK_NULL_HANDLE;
        return gpu_failed_for("vkAllocateCommandBuffers", name, result);
    }
    result = begin_commands(upload->commands);
    return result == VK_SUCCESS ? STATUS_OK
                                : gpu_failed_for("vkBeginCommandBuffer", upload->name, result);
}

static enum status submit(struct gpu *gpu, struct gpu_upload *upload)
{
    const VkCommandBufferSubmitInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .commandBuffer = upload->commands,
    };
    const VkSubmitInfo2 info = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .commandBufferInfoCount = 1,
        .pCommandBufferInfos = &commands,
    };
    VkResult result = vkQueueSubmit2(gpu->queue, 1, &info, upload->fence);
    if (result != VK_SUCCESS)
        return gpu_failed_for("vkQueueSubmit2", upload->name, result);
    upload->submitted = true;
    result = vkWaitForFences(gpu->device, 1, &upload->fence, VK_TRUE, UINT64_MAX);
    if (result != VK_SUCCESS)
        return gpu_failed_for("vkWaitForFences", upload->name, result);
    upload->submitted = false;
    result = vkResetFences(gpu->device, 1, &upload->fence);
    return result == VK_SUCCESS ? STATUS_OK : gpu_failed_for("vkResetFences", upload->name, result);
}

enum status gpu_upload_flush(struct gpu *gpu, struct gpu_upload *upload)
{
    /* VK_WHOLE_SIZE avoids rounding to nonCoherentAtomSize. */
    const VkMappedMemoryRange range = {
        .sType = VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE,
        .memory = upload->staging.memory,
        .size = VK_WHOLE_SIZE,
    };
    VkResult result = vkFlushMappedMemoryRanges(gpu->device, 1, &range);
    if (result != VK_SUCCESS)
        return gpu_failed_for("vkFlushMappedMemoryRanges", upload->name, result);
    result = vkEndCommandBuffer(upload->commands);
    if (result != VK_SUCCESS)
        return gpu_failed_for("vkEndCommandBuffer", upload->name, result);
    const enum status status = submit(gpu, upload);
    if (status != STATUS_OK)
        return status;
    result = begin_commands(upload->commands);
    return result == VK_SUCCESS ? STATUS_OK
                                : gpu_failed_for("vkBeginCommandBuffer", upload->name, result);
}

void gpu_upload_finish(struct gpu *gpu, struct gpu_upload *upload)
{
    if (upload->submitted) /* a wait has failed, so the commands may still execute */
        (void)vkDeviceWaitIdle(gpu->device);
    if (upload->commands)
        vkFreeCommandBuffers(gpu->device, gpu->pool, 1, &upload->commands);
    vkDestroyFence(gpu->device, upload->fence, NULL);
    gpu_buffer_destroy(gpu, &upload->staging);
    *upload = (struct gpu_upload){ 0 };
}
