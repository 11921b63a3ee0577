/* gpu_buffer.c: creates device-local buffers and fills them through a staging buffer. */
#include <string.h>
#include "src/gpu/gpu_internal.h"

void gpu_record_visible(VkCommandBuffer commands, VkPipelineStageFlags2 stage,
                        VkAccessFlags2 access)
{
    const VkMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = stage,
        .srcAccessMask = access,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
    };
    const VkDependencyInfo dependency = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .memoryBarrierCount = 1,
        .pMemoryBarriers = &barrier,
    };
    vkCmdPipelineBarrier2(commands, &dependency);
}

static enum status fill(struct gpu *gpu, const struct gpu_buffer *buffer, const void *data,
                        const char *name)
{
    struct gpu_upload upload = { 0 };
    enum status status = gpu_upload_begin(gpu, &upload, buffer->size, name);
    VkDeviceSize done = 0;
    while (status == STATUS_OK && done < buffer->size) {
        const VkDeviceSize left = buffer->size - done;
        const VkBufferCopy copy = {
            .dstOffset = done,
            .size = left < upload.staging.size ? left : upload.staging.size,
        };
        memcpy(upload.mapped, (const char *)data + done, copy.size);
        vkCmdCopyBuffer(upload.commands, upload.staging.buffer, buffer->buffer, 1, &copy);
        done += copy.size;
        if (done == buffer->size)
            gpu_record_visible(upload.commands, VK_PIPELINE_STAGE_2_COPY_BIT,
                               VK_ACCESS_2_TRANSFER_WRITE_BIT);
        status = gpu_upload_flush(gpu, &upload);
    }
    gpu_upload_finish(gpu, &upload);
    return status;
}

enum status gpu_buffer_create(struct gpu *gpu, struct gpu_buffer *buffer, VkBufferUsageFlags usage,
                              const void *data, VkDeviceSize size, const char *name)
{
    *buffer = (struct gpu_buffer){ 0 };
    if (size == 0)
        return STATUS_OK;
    enum status status =
        gpu_memory_buffer(gpu, buffer, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, size, false, name);
    if (status == STATUS_OK)
        status = fill(gpu, buffer, data, name);
    if (status != STATUS_OK)
        gpu_buffer_destroy(gpu, buffer);
    return status;
}
