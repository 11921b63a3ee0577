/* clear.c: what is done before the first frame: persistent resources become zero, and are brought
 * into the layouts that the plan's frames expect. */
#include "graph/exec/exec.h"

static const VkImageLayout clear_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;

void rg_exec_record_move(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                         const VkImageSubresourceRange *range, VkImageLayout from, VkImageLayout to)
{
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = *range,
    };
    exec->vk.CmdPipelineBarrier2(commands, &(VkDependencyInfo){
                                               .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                               .imageMemoryBarrierCount = 1,
                                               .pImageMemoryBarriers = &barrier,
                                           });
}

void rg_exec_record_clear_image(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                                const VkImageSubresourceRange *range,
                                const VkClearColorValue *color)
{
    const VkClearDepthStencilValue depth = { color->float32[0], 0 };
    rg_exec_record_move(exec, commands, image, range, VK_IMAGE_LAYOUT_UNDEFINED, clear_layout);
    if (range->aspectMask & VK_IMAGE_ASPECT_COLOR_BIT)
        exec->vk.CmdClearColorImage(commands, image, clear_layout, color, 1, range);
    else
        exec->vk.CmdClearDepthStencilImage(commands, image, clear_layout, &depth, 1, range);
}

void rg_exec_record_clear(struct rg_exec *exec, VkCommandBuffer commands)
{
    const struct rg_plan *plan = exec->plan;
    const VkClearColorValue zero = { { 0 } };
    for (uint32_t i = 0; i < plan->image_count; i++) {
        const VkImageSubresourceRange all = rg_exec_whole(&plan->images[i]);
        if (plan->images[i].persistent)
            rg_exec_record_clear_image(exec, commands, exec->image_set->images[i], &all, &zero);
    }
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        if (plan->buffers[i].persistent)
            exec->vk.CmdFillBuffer(commands, rg_exec_buffer(exec, i, exec->slot)->buffer, 0,
                                   VK_WHOLE_SIZE, 0);
    }
    rg_exec_record_batch(exec, commands, plan->first_initial_barrier, plan->initial_barrier_count);
}
