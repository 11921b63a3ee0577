/* warm_up_draws.c: invisible draws, for drivers that compile pipelines at the first draw. */
#include <string.h>
#include "graph/exec/executor_internal.h"

/* buffer size in bytes that suffices for three indices and for a vertex of any layout */
static const VkDeviceSize blank_size = 1024;

VkResult rg_exec_make_warm_up(struct rg_exec *exec)
{
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = blank_size,
        .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
    };
    struct exec_buffer blank;
    VkResult result = VK_SUCCESS;
    if (!exec->params.warm_up_only)
        return result;
    RG_TRY(rg_exec_make_host_buffer(exec, &info, VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                    "blank triangle", 0, &blank));
    exec->triangle = blank.buffer;
    /* host-coherent memory needs no flush */
    memset(blank.mapped, 0, blank_size);
fail:
    return result;
}

/* Transitions a subresource range to a layout, discarding its content. */
static void prepare(const struct rg_exec *exec, VkCommandBuffer commands, VkImage image,
                    VkImageSubresourceRange range, VkImageLayout layout)
{
    rg_exec_record_transition(exec, commands, image, &range, VK_IMAGE_LAYOUT_UNDEFINED, layout);
}

static void prepare_pass(const struct rg_exec *exec, VkCommandBuffer commands,
                         const struct rg_plan_pass *pass)
{
    const VkImage *images = exec->image_set->images;
    struct rg_plan_target targets[RG_ATTACHMENT_COUNT];
    uint32_t target_count = rg_exec_attachments(pass, targets);
    for (uint32_t i = 0; i < pass->use_count; i++) {
        const struct rg_plan_use *use = &exec->plan->uses[pass->first_use + i];
        if (use->image != RG_NONE)
            prepare(exec, commands, images[use->image], use->range, use->layout);
    }
    for (uint32_t i = 0; i < pass->fallback_count; i++) {
        const struct exec_fallback *fallback = &exec->fallbacks[pass->first_fallback + i];
        prepare(exec, commands, fallback->image, rg_exec_full_range(&fallback->described),
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    for (uint32_t i = 0; i < target_count; i++) {
        const struct rg_plan_target *t = &targets[i];
        VkImageAspectFlags aspects = exec->plan->images[t->image].aspects;
        prepare(exec, commands, images[t->image],
                (VkImageSubresourceRange){ aspects, t->mip, 1, t->layer, 1 }, t->layout);
    }
}

VkResult rg_exec_warm_up(struct rg_exec *exec, const struct rg_frame *frame, uint32_t pass)
{
    struct exec_slot *slot = &exec->slots[0];
    struct rg_cmd cmd = {
        .exec = exec,
        .index = pass,
        .plan_pass = &exec->plan->passes[pass],
        .pass = &exec->passes[pass],
        .commands = slot->commands,
        .area = { .extent = exec->plan->passes[pass].extent },
        .warm_up = true,
    };
    const struct rg_pass *row = cmd.plan_pass->pass;
    const VkCommandBufferSubmitInfo commands = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .commandBuffer = slot->commands,
    };
    const VkSubmitInfo2 info = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .commandBufferInfoCount = 1,
        .pCommandBufferInfos = &commands,
    };
    VkResult result = VK_SUCCESS;
    if (row->kind != RG_RASTER || !cmd.pass->first || row->set ||
        (row->when && !row->when(frame, cmd.plan_pass->repetition)))
        return VK_SUCCESS;
    exec->slot = 0;
    RG_CALL(exec, row->name, BeginCommandBuffer, cmd.commands, &rg_exec_commands_once);
    prepare_pass(exec, cmd.commands, cmd.plan_pass);
    rg_exec_record_work(&cmd, frame);
    RG_CALL(exec, row->name, EndCommandBuffer, cmd.commands);
    RG_CALL(exec, row->name, QueueSubmit2, exec->params.queue, 1, &info, slot->fence);
    slot->submitted = true;
    RG_CALL(exec, row->name, WaitForFences, exec->device, 1, &slot->fence, VK_TRUE, UINT64_MAX);
    slot->submitted = false;
    RG_CALL(exec, row->name, ResetFences, exec->device, 1, &slot->fence);
fail:
    return result;
}
