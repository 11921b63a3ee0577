/* clear.c: before the first frame: persistent resources become zero, and are where the plan's
 * frames expect them. */
#include "graph/exec/exec.h"

static const VkImageLayout fill_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;

/* Nobody has used the image yet, so there is nothing to wait for. */
static void prepare_image(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                          const VkImageSubresourceRange *range)
{
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .dstStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT,
        .dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
        .oldLayout = VK_IMAGE_LAYOUT_UNDEFINED,
        .newLayout = fill_layout,
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

static void fill_image(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                       const struct rg_plan_image *plan)
{
    const VkImageSubresourceRange range = { plan->aspects, 0, plan->mips, 0, plan->layers };
    prepare_image(exec, commands, image, &range);
    if (plan->aspects & VK_IMAGE_ASPECT_COLOR_BIT)
        exec->vk.CmdClearColorImage(commands, image, fill_layout, &(VkClearColorValue){ { 0 } }, 1,
                                    &range);
    else
        exec->vk.CmdClearDepthStencilImage(commands, image, fill_layout,
                                           &(VkClearDepthStencilValue){ 0 }, 1, &range);
}

void rg_exec_record_clear(struct rg_exec *exec, VkCommandBuffer commands)
{
    const struct rg_plan *plan = exec->plan;
    for (uint32_t i = 0; i < plan->image_count; i++) {
        if (plan->images[i].persistent)
            fill_image(exec, commands, exec->images[i], &plan->images[i]);
    }
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        if (plan->buffers[i].persistent)
            exec->vk.CmdFillBuffer(commands, rg_exec_buffer(exec, i, exec->slot), 0, VK_WHOLE_SIZE,
                                   0);
    }
    rg_exec_record_batch(exec, commands, plan->first_initial_barrier, plan->initial_barrier_count);
}
