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

/* Adds the transitions of kept images from the layouts in which the previous plan left them.
 * `kept` has 1 plus the new index of each image of that plan; 0: not kept. */
static void add_moves(struct rg_exec *exec, const struct rg_exec *former, const uint32_t *kept)
{
    const struct rg_plan *plan = former->plan;
    for (uint32_t i = 0; i < plan->initial_barrier_count && former->initialized; i++) {
        const struct rg_barrier *b = &plan->barriers[plan->first_initial_barrier + i];
        if (b->image != RG_NONE && kept[b->image])
            exec->transitions[exec->transition_count++] =
                (struct exec_transition){ kept[b->image] - 1, b->range, b->new_layout };
    }
    /* the previous plan drew no frame */
    for (uint32_t i = 0; i < former->transition_count && !former->initialized; i++) {
        struct exec_transition move = former->transitions[i];
        if (!kept[move.image])
            continue;
        move.image = kept[move.image] - 1;
        exec->transitions[exec->transition_count++] = move;
    }
}

VkResult rg_exec_keep_content(struct rg_exec *exec, const struct rg_exec *former)
{
    const struct rg_plan *plan = exec->plan;
    uint32_t *kept;
    if (!RG_MAKE_ARRAY(exec, kept, former->plan->image_count) ||
        !RG_MAKE_ARRAY(exec, exec->transitions,
                       (size_t)former->plan->initial_barrier_count + former->transition_count))
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    for (uint32_t i = 0; i < plan->image_count + plan->buffer_count; i++) {
        uint32_t *origin = &exec->origins[i];
        const uint32_t first = i < plan->image_count ? 0 : former->plan->image_count;
        if (*origin && !former->initialized && !former->origins[first + *origin - 1])
            *origin = 0;
        if (*origin && i < plan->image_count)
            kept[*origin - 1] = i + 1;
    }
    add_moves(exec, former, kept);
    return VK_SUCCESS;
}

void rg_exec_record_wait(const struct rg_exec *exec, VkCommandBuffer commands)
{
    const VkMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
    };
    exec->vk.CmdPipelineBarrier2(commands, &(VkDependencyInfo){
                                               .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                               .memoryBarrierCount = 1,
                                               .pMemoryBarriers = &barrier,
                                           });
}

void rg_exec_record_clear(struct rg_exec *exec, VkCommandBuffer commands)
{
    const struct rg_plan *plan = exec->plan;
    const VkClearColorValue zero = { { 0 } };
    if (exec->is_update) /* the memory is in use by frames of the previous plan */
        rg_exec_record_wait(exec, commands);
    for (uint32_t i = 0; i < exec->transition_count; i++) {
        const struct exec_transition *move = &exec->transitions[i];
        rg_exec_record_transition(exec, commands, exec->image_set->images[move->image],
                                  &move->range, move->from, clear_layout);
    }
    for (uint32_t i = 0; i < plan->image_count; i++) {
        const VkImageSubresourceRange all = rg_exec_full_range(&plan->images[i]);
        if (plan->images[i].persistent && !exec->origins[i])
            rg_exec_record_clear_image(exec, commands, exec->image_set->images[i], &all, &zero);
    }
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        if (plan->buffers[i].persistent && !exec->origins[plan->image_count + i])
            exec->vk.CmdFillBuffer(commands, rg_exec_buffer(exec, i, exec->slot)->buffer, 0,
                                   VK_WHOLE_SIZE, 0);
    }
    rg_exec_add_batch(exec, commands, plan->first_initial_barrier, plan->initial_barrier_count);
    rg_exec_record_batch(exec, commands);
}
