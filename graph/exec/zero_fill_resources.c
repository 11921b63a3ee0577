/* zero_fill_resources.c: zero-fills persistent resources before a plan's first frame, unless they
 * keep content. Moves images to the layouts in which frames begin. */
#include "graph/exec/executor_internal.h"

static const VkImageLayout clear_layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;

void rg_exec_record_transition(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                               const VkImageSubresourceRange *range, VkImageLayout from,
                               VkImageLayout to)
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
    rg_exec_record_transition(exec, commands, image, range, VK_IMAGE_LAYOUT_UNDEFINED,
                              clear_layout);
    if (range->aspectMask & VK_IMAGE_ASPECT_COLOR_BIT)
        exec->vk.CmdClearColorImage(commands, image, clear_layout, color, 1, range);
    else
        exec->vk.CmdClearDepthStencilImage(commands, image, clear_layout, &depth, 1, range);
}

/* Adds transitions of a persistent image from the layouts in which the previous plan left it. */
static void add_moves(struct rg_exec *exec, const struct rg_exec *former, uint32_t index)
{
    const struct rg_plan *plan = former->plan;
    VkImage image = former->image_sets->images[index];
    for (uint32_t i = 0; i < plan->initial_barrier_count && former->initialized; i++) {
        const struct rg_barrier *b = &plan->barriers[plan->first_initial_barrier + i];
        if (b->image == index)
            exec->transitions[exec->transition_count++] =
                (struct exec_transition){ image, b->range, b->new_layout };
    }
    /* the previous plan drew no frame */
    for (uint32_t i = 0; i < former->transition_count && !former->initialized; i++) {
        if (former->transitions[i].image == image)
            exec->transitions[exec->transition_count++] = former->transitions[i];
    }
}

VkResult rg_exec_keep_content(struct rg_exec *exec, const struct rg_exec *former)
{
    const struct rg_plan *plan = exec->plan;
    const struct rg_plan *before = former->plan;
    if (!RG_MAKE_ARRAY(exec, exec->transitions,
                       (size_t)before->initial_barrier_count + former->transition_count))
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    for (uint32_t i = 0; i < plan->image_count; i++) {
        uint32_t k = 0;
        while (exec->has_content[i] && /* the previous plan has it */
               former->image_sets->images[k] != exec->image_sets->images[i])
            k++;
        exec->has_content[i] &= former->initialized || former->has_content[k];
        if (exec->has_content[i])
            add_moves(exec, former, k);
    }
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        bool *has_content = &exec->has_content[plan->image_count + i];
        uint32_t k = 0;
        while (*has_content &&
               rg_exec_buffer(former, k, 0)->buffer != rg_exec_buffer(exec, i, 0)->buffer)
            k++;
        *has_content &= former->initialized || former->has_content[before->image_count + k];
    }
    return VK_SUCCESS;
}

void rg_exec_record_clear(struct rg_exec *exec, VkCommandBuffer commands)
{
    const struct rg_plan *plan = exec->plan;
    const VkClearColorValue zero = { { 0 } };
    for (uint32_t i = 0; i < exec->transition_count; i++) {
        const struct exec_transition *move = &exec->transitions[i];
        rg_exec_record_transition(exec, commands, move->image, &move->range, move->from,
                                  clear_layout);
    }
    for (uint32_t i = 0; i < plan->image_count; i++) {
        const VkImageSubresourceRange all = rg_exec_full_range(&plan->images[i]);
        if (plan->images[i].persistent && !exec->has_content[i])
            rg_exec_record_clear_image(exec, commands, exec->image_set->images[i], &all, &zero);
    }
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        if (plan->buffers[i].persistent && !exec->has_content[plan->image_count + i])
            exec->vk.CmdFillBuffer(commands, rg_exec_buffer(exec, i, exec->slot)->buffer, 0,
                                   VK_WHOLE_SIZE, 0);
    }
    rg_exec_add_batch(exec, commands, plan->first_initial_barrier, plan->initial_barrier_count);
    rg_exec_record_batch(exec, commands);
}
