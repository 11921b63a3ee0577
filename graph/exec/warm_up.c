/* warm_up.c: draws of which nothing can be seen, for drivers that compile at the first draw. */
#include <string.h>
#include "graph/exec/exec.h"

/* bytes: room for a vertex of any layout, and for three indices */
static const VkDeviceSize blank_size = 1024;

VkResult rg_exec_make_warm_up(struct rg_exec *exec)
{
    static const char name[] = "blank triangle";
    VkMemoryRequirements needs;
    void *mapped;
    VkResult result;
    if (!exec->params.warm_up_only)
        return VK_SUCCESS;
    RG_MAKE(exec, name, CreateBuffer, &exec->triangle,
            &(VkBufferCreateInfo){
                .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                .size = blank_size,
                .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
            });
    exec->vk.GetBufferMemoryRequirements(exec->device, exec->triangle, &needs);
    RG_PASS(rg_exec_allocate(
        exec, &needs, 0, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
        name, &exec->triangle_memory));
    RG_CALL(exec, name, BindBufferMemory, exec->device, exec->triangle, exec->triangle_memory, 0);
    RG_CALL(exec, name, MapMemory, exec->device, exec->triangle_memory, 0, VK_WHOLE_SIZE, 0,
            &mapped);
    memset(mapped, 0, blank_size); /* freeing the memory unmaps it */
fail:
    return result;
}

void rg_exec_free_warm_up(struct rg_exec *exec)
{
    exec->vk.DestroyBuffer(exec->device, exec->triangle, NULL);
    exec->vk.FreeMemory(exec->device, exec->triangle_memory, NULL);
}

/* Brings a range into a layout, with undefined content, which it has had before as well. */
static void prepare(const struct rg_exec *exec, VkCommandBuffer commands, uint32_t image,
                    VkImageSubresourceRange range, VkImageLayout layout)
{
    rg_exec_record_move(exec, commands, exec->images[image], &range, VK_IMAGE_LAYOUT_UNDEFINED,
                        layout);
}

static void prepare_target(const struct rg_exec *exec, VkCommandBuffer commands,
                           const struct rg_plan_target *t)
{
    const struct rg_plan_image *images = exec->plan->images;
    if (t->image != RG_NONE)
        prepare(exec, commands, t->image,
                (VkImageSubresourceRange){ images[t->image].aspects, t->mip, 1, t->layer, 1 },
                t->layout);
    if (t->image != RG_NONE && t->resolve != RG_NONE)
        prepare(exec, commands, t->resolve,
                (VkImageSubresourceRange){ images[t->resolve].aspects, t->resolve_mip, 1,
                                           t->resolve_layer, 1 },
                VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

static void prepare_pass(const struct rg_exec *exec, VkCommandBuffer commands,
                         const struct rg_plan_pass *pass)
{
    for (uint32_t i = 0; i < pass->use_count; i++) {
        const struct rg_plan_use *use = &exec->plan->uses[pass->first_use + i];
        if (use->image != RG_NONE)
            prepare(exec, commands, use->image, use->range, use->layout);
    }
    for (uint32_t i = 0; i < pass->fallback_count; i++)
        rg_exec_discard_fallback(exec, commands, pass->first_fallback + i);
    for (uint32_t i = 0; i < pass->color_count; i++)
        prepare_target(exec, commands, &pass->color[i]);
    prepare_target(exec, commands, &pass->depth);
}

static VkResult record(struct rg_exec *exec, VkCommandBuffer commands, uint32_t index,
                       const struct rg_frame *frame)
{
    struct rg_cmd cmd = {
        .exec = exec,
        .plan_pass = &exec->plan->passes[index],
        .pass = &exec->passes[index],
        .commands = commands,
        .warm_up = true,
    };
    const char *name = cmd.plan_pass->pass->name;
    VkResult result;
    RG_CALL(exec, name, BeginCommandBuffer, commands,
            &(VkCommandBufferBeginInfo){
                .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
            });
    prepare_pass(exec, commands, cmd.plan_pass);
    rg_exec_record_work(&cmd, frame);
    RG_CALL(exec, name, EndCommandBuffer, commands);
fail:
    return result;
}

VkResult rg_exec_warm_up(struct rg_exec *exec, const struct rg_frame *frame, uint32_t pass)
{
    const struct rg_pass *row = exec->plan->passes[pass].pass;
    struct exec_slot *slot = &exec->slots[0];
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
    if (row->kind != RG_RASTER || !exec->passes[pass].owner || exec->passes[pass].shares ||
        (row->when && !row->when(frame, exec->plan->passes[pass].repetition)))
        return VK_SUCCESS;
    exec->slot = 0;
    RG_PASS(record(exec, slot->commands, pass, frame));
    RG_CALL(exec, row->name, QueueSubmit2, exec->params.queue, 1, &info, slot->fence);
    slot->submitted = true;
    RG_CALL(exec, row->name, WaitForFences, exec->device, 1, &slot->fence, VK_TRUE, UINT64_MAX);
    slot->submitted = false;
    RG_CALL(exec, row->name, ResetFences, exec->device, 1, &slot->fence);
fail:
    return result;
}
