/* record.c: records barriers, targets and labels of passes; the functions of rg_cmd.h. */
#include <assert.h>
#include <string.h>
#include "graph/exec/exec.h"
#include "graph/rg_cmd.h"

/* ---- barriers ---- */

static VkImageMemoryBarrier2 image_barrier(const struct rg_exec *exec, const struct rg_barrier *b)
{
    return (VkImageMemoryBarrier2){
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = b->src_stages,
        .srcAccessMask = b->src_access,
        .dstStageMask = b->dst_stages,
        .dstAccessMask = b->dst_access,
        .oldLayout = b->old_layout,
        .newLayout = b->new_layout,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = exec->images[b->image],
        .subresourceRange = b->range,
    };
}

static VkBufferMemoryBarrier2 buffer_barrier(const struct rg_exec *exec, const struct rg_barrier *b)
{
    return (VkBufferMemoryBarrier2){
        .sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
        .srcStageMask = b->src_stages,
        .srcAccessMask = b->src_access,
        .dstStageMask = b->dst_stages,
        .dstAccessMask = b->dst_access,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .buffer = rg_exec_buffer(exec, b->buffer, exec->slot),
        .size = VK_WHOLE_SIZE,
    };
}

void rg_exec_record_batch(struct rg_exec *exec, VkCommandBuffer commands, uint32_t first,
                          uint32_t count)
{
    uint32_t images = 0;
    uint32_t buffers = 0;
    for (uint32_t i = first; i < first + count; i++) {
        const struct rg_barrier *b = &exec->plan->barriers[i];
        if (b->image != RG_NONE)
            exec->image_batch[images++] = image_barrier(exec, b);
        else
            exec->buffer_batch[buffers++] = buffer_barrier(exec, b);
    }
    const VkDependencyInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .bufferMemoryBarrierCount = buffers,
        .pBufferMemoryBarriers = exec->buffer_batch,
        .imageMemoryBarrierCount = images,
        .pImageMemoryBarriers = exec->image_batch,
    };
    if (count)
        exec->vk.CmdPipelineBarrier2(commands, &info);
}

/* ---- targets ---- */

static VkRenderingAttachmentInfo attachment(const struct rg_plan_target *target,
                                            const struct rg_target *row, VkImageView view)
{
    return (VkRenderingAttachmentInfo){
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = view,
        .imageLayout = target->layout,
        .loadOp = target->load,
        .storeOp = target->store,
        .clearValue = row->clear,
    };
}

/* A warm-up draws nothing into its targets, so it neither loads nor stores them. */
static VkRenderingAttachmentInfo untouched(VkRenderingAttachmentInfo info)
{
    info.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    info.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return info;
}

/* Integer formats cannot be averaged; their names tell them. */
static VkResolveModeFlagBits resolve_mode(const struct rg_plan_image *image)
{
    const char *name = rg_format_info(image->image->format)->name;
    bool integer = strstr(name, "_UINT") || strstr(name, "_SINT");
    return integer ? VK_RESOLVE_MODE_SAMPLE_ZERO_BIT : VK_RESOLVE_MODE_AVERAGE_BIT;
}

static void begin_rendering(const struct rg_cmd *cmd)
{
    const struct rg_plan_pass *plan = cmd->plan_pass;
    VkRenderingAttachmentInfo attachments[RG_COLOR_COUNT + 1];
    bool has_depth = plan->depth.image != RG_NONE;
    uint32_t count = plan->color_count;
    const VkImageView *views = rg_exec_targets(cmd->exec, cmd->pass)->views;
    const VkImageView *resolve_view = &views[count + has_depth];
    for (uint32_t i = 0; i < count; i++) {
        const struct rg_plan_target *target = &plan->color[i];
        attachments[i] = attachment(target, &plan->pass->color[i], views[i]);
        if (target->resolve == RG_NONE)
            continue;
        attachments[i].resolveMode = resolve_mode(&cmd->exec->plan->images[target->resolve]);
        attachments[i].resolveImageView = *resolve_view++;
        attachments[i].resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    if (has_depth)
        attachments[count] = attachment(&plan->depth, &plan->pass->depth, views[count]);
    bool has_stencil = has_depth && cmd->exec->plan->images[plan->depth.image].aspects &
                                        VK_IMAGE_ASPECT_STENCIL_BIT;
    for (uint32_t i = 0; cmd->warm_up && i < count + has_depth; i++)
        attachments[i] = untouched(attachments[i]);
    const VkRenderingInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = rg_exec_area(cmd->exec, plan),
        .layerCount = 1,
        .colorAttachmentCount = count,
        .pColorAttachments = attachments,
        .pDepthAttachment = has_depth ? &attachments[count] : NULL,
        .pStencilAttachment = has_stencil ? &attachments[count] : NULL,
    };
    cmd->exec->vk.CmdBeginRendering(cmd->commands, &info);
}

static void begin_render_pass(const struct rg_cmd *cmd)
{
    const struct rg_plan_pass *plan = cmd->plan_pass;
    VkClearValue clears[RG_COLOR_COUNT + 1];
    for (uint32_t i = 0; i < plan->color_count; i++)
        clears[i] = plan->pass->color[i].clear;
    clears[plan->color_count] = plan->pass->depth.clear;
    const VkRenderPassBeginInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
        .renderPass = cmd->pass->render_pass,
        .framebuffer = rg_exec_targets(cmd->exec, cmd->pass)->framebuffer,
        .renderArea = rg_exec_area(cmd->exec, plan),
        .clearValueCount = plan->color_count + 1,
        .pClearValues = clears,
    };
    cmd->exec->vk.CmdBeginRenderPass(cmd->commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

/* ---- passes ---- */

static void bind(const struct rg_cmd *cmd)
{
    const struct rg_plan_pass *plan = cmd->plan_pass;
    VkPipelineBindPoint point = plan->pass->kind == RG_COMPUTE ? VK_PIPELINE_BIND_POINT_COMPUTE
                                                               : VK_PIPELINE_BIND_POINT_GRAPHICS;
    if (plan->pass->kind == RG_TRANSFER)
        return;
    cmd->exec->vk.CmdBindPipeline(cmd->commands, point, cmd->pass->pipeline);
    cmd->exec->vk.CmdBindDescriptorSets(cmd->commands, point, cmd->pass->layout, 0, 1,
                                        rg_exec_set(cmd->exec, cmd->pass, cmd->exec->slot), 0,
                                        NULL);
    if (plan->pass->kind != RG_RASTER)
        return;
    const VkViewport viewport = {
        .width = (float)plan->extent.width,
        .height = (float)plan->extent.height,
        .maxDepth = 1.0f,
    };
    cmd->exec->vk.CmdSetViewport(cmd->commands, 0, 1, &viewport);
    const VkRect2D area = cmd->warm_up ? (VkRect2D){ 0 } : rg_exec_area(cmd->exec, plan);
    cmd->exec->vk.CmdSetScissor(cmd->commands, 0, 1, &area);
}

void rg_exec_record_work(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    bool raster = cmd->plan_pass->pass->kind == RG_RASTER;
    if (raster && cmd->pass->render_pass)
        begin_render_pass(cmd);
    else if (raster)
        begin_rendering(cmd);
    bind(cmd);
    cmd->plan_pass->pass->record(cmd, frame);
    if (raster && cmd->pass->render_pass)
        cmd->exec->vk.CmdEndRenderPass(cmd->commands);
    else if (raster)
        cmd->exec->vk.CmdEndRendering(cmd->commands);
}

static void record_pass(struct rg_exec *exec, uint32_t index, VkCommandBuffer commands,
                        const struct rg_frame *frame)
{
    struct rg_cmd cmd = {
        .exec = exec,
        .plan_pass = &exec->plan->passes[index],
        .pass = &exec->passes[index],
        .commands = commands,
    };
    const struct rg_pass *row = cmd.plan_pass->pass;
    if (exec->vk.CmdBeginDebugUtilsLabelEXT)
        exec->vk.CmdBeginDebugUtilsLabelEXT(commands,
                                            &(VkDebugUtilsLabelEXT){
                                                .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                                .pLabelName = row->name,
                                            });
    rg_time_begin_pass(exec, commands, index);
    rg_exec_record_batch(exec, commands, cmd.plan_pass->first_barrier,
                         cmd.plan_pass->barrier_count);
    if (!row->when || row->when(frame, cmd.plan_pass->repetition))
        rg_exec_record_work(&cmd, frame);
    rg_time_end_pass(exec, commands, index);
    if (exec->vk.CmdEndDebugUtilsLabelEXT)
        exec->vk.CmdEndDebugUtilsLabelEXT(commands);
}

VkResult rg_exec_record(struct rg_exec *exec, const struct rg_frame *frame, uint32_t first,
                        uint32_t count)
{
    VkCommandBuffer commands = exec->slots[exec->slot].commands;
    const struct rg_plan *plan = exec->plan;
    VkResult result;
    RG_CALL(exec, NULL, BeginCommandBuffer, commands,
            &(VkCommandBufferBeginInfo){
                .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
            });
    if (first == 0 && !exec->filled)
        rg_exec_record_clear(exec, commands);
    if (first == 0 && !exec->filled)
        rg_exec_record_fallbacks(exec, commands);
    if (first == 0)
        rg_time_begin_frame(exec, commands);
    for (uint32_t p = first; p < first + count; p++)
        record_pass(exec, p, commands, frame);
    if (first + count == plan->pass_count)
        rg_exec_record_batch(exec, commands, plan->first_final_barrier, plan->final_barrier_count);
    RG_CALL(exec, NULL, EndCommandBuffer, commands);
fail:
    return result;
}

/* ---- rg_cmd.h ---- */

const struct rg_pass *rg_cmd_pass(const struct rg_cmd *cmd)
{
    return cmd->plan_pass->pass;
}

uint32_t rg_cmd_repetition(const struct rg_cmd *cmd)
{
    return cmd->plan_pass->repetition;
}

VkExtent2D rg_cmd_extent(const struct rg_cmd *cmd)
{
    return cmd->plan_pass->extent;
}

void rg_cmd_push(struct rg_cmd *cmd, const void *data, uint32_t size)
{
    cmd->exec->vk.CmdPushConstants(cmd->commands, cmd->pass->layout,
                                   rg_exec_stages(cmd->plan_pass->pass), 0, size, data);
}

void rg_cmd_draw(struct rg_cmd *cmd, uint32_t vertex_count)
{
    cmd->exec->vk.CmdDraw(cmd->commands, cmd->warm_up ? 3 : vertex_count, 1, 0, 0);
}

static void bind_mesh(const struct rg_cmd *cmd, const struct rg_mesh *mesh)
{
    const struct rg_exec *exec = cmd->exec;
    const VkDeviceSize offset = 0;
    const VkBuffer *vertices = cmd->warm_up ? &exec->triangle : &mesh->vertices;
    exec->vk.CmdBindVertexBuffers(cmd->commands, 0, 1, vertices, &offset);
    exec->vk.CmdBindIndexBuffer(cmd->commands, cmd->warm_up ? exec->triangle : mesh->indices, 0,
                                VK_INDEX_TYPE_UINT32);
}

void rg_cmd_draw_mesh_part(struct rg_cmd *cmd, const struct rg_mesh *mesh, uint32_t first,
                           uint32_t count)
{
    if (!count)
        return;
    bind_mesh(cmd, mesh);
    if (cmd->warm_up)
        cmd->exec->vk.CmdDrawIndexed(cmd->commands, 3, 1, 0, 0, 0);
    else
        cmd->exec->vk.CmdDrawIndexed(cmd->commands, count, 1, first, 0, 0);
}

void rg_cmd_draw_mesh(struct rg_cmd *cmd, const struct rg_mesh *mesh)
{
    rg_cmd_draw_mesh_part(cmd, mesh, 0, mesh->index_count);
}

void rg_cmd_scissor(struct rg_cmd *cmd, VkRect2D rectangle)
{
    const VkRect2D both = rg_exec_within(rectangle, rg_exec_area(cmd->exec, cmd->plan_pass));
    if (!cmd->warm_up)
        cmd->exec->vk.CmdSetScissor(cmd->commands, 0, 1, &both);
}

void rg_cmd_dispatch(struct rg_cmd *cmd, uint32_t x, uint32_t y, uint32_t z)
{
    cmd->exec->vk.CmdDispatch(cmd->commands, x, y, z);
}

/* Returns the row's first use of a resource with an access, or with any if `access` is none. */
static const struct rg_plan_use *find_use(const struct rg_cmd *cmd, const void *resource,
                                          enum rg_access access)
{
    for (uint32_t i = 0; i < cmd->plan_pass->use_count; i++) {
        const struct rg_plan_use *use = &cmd->exec->plan->uses[cmd->plan_pass->first_use + i];
        const void *used =
            use->use->image ? (const void *)use->use->image : (const void *)use->use->buffer;
        if (used == resource && (!access || use->use->access == access))
            return use;
    }
    return NULL;
}

static VkBuffer indirect_buffer(const struct rg_cmd *cmd, const struct rg_buffer *buffer)
{
    const struct rg_plan_use *use = find_use(cmd, buffer, RG_INDIRECT);
    assert(use); /* the row names it */
    return rg_exec_buffer(cmd->exec, use->buffer, cmd->exec->slot);
}

void rg_cmd_draw_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer, VkDeviceSize offset)
{
    if (cmd->warm_up)
        rg_cmd_draw(cmd, 3);
    else
        cmd->exec->vk.CmdDrawIndirect(cmd->commands, indirect_buffer(cmd, buffer), offset, 1, 0);
}

void rg_cmd_draw_mesh_indirect(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                               const struct rg_buffer *buffer, VkDeviceSize offset)
{
    if (cmd->warm_up) {
        rg_cmd_draw_mesh_part(cmd, mesh, 0, 3);
        return;
    }
    bind_mesh(cmd, mesh);
    cmd->exec->vk.CmdDrawIndexedIndirect(cmd->commands, indirect_buffer(cmd, buffer), offset, 1, 0);
}

void rg_cmd_dispatch_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                              VkDeviceSize offset)
{
    cmd->exec->vk.CmdDispatchIndirect(cmd->commands, indirect_buffer(cmd, buffer), offset);
}

static VkBufferImageCopy copy_region(const struct rg_cmd *cmd, const struct rg_plan_use *use,
                                     VkDeviceSize offset)
{
    const struct rg_plan_image *image = &cmd->exec->plan->images[use->image];
    uint32_t mip = use->range.baseMipLevel;
    uint32_t width = image->extent.width >> mip;
    uint32_t height = image->extent.height >> mip;
    const VkRect2D whole = { .extent = { width ? width : 1, height ? height : 1 } };
    const VkRect2D area =
        rg_exec_is_limited(cmd->exec, cmd->plan_pass) ? cmd->exec->region.region : whole;
    return (VkBufferImageCopy){
        .bufferOffset = offset,
        .imageSubresource = { use->range.aspectMask, mip, use->range.baseArrayLayer,
                              use->range.layerCount },
        .imageOffset = { area.offset.x, area.offset.y, 0 },
        .imageExtent = { area.extent.width, area.extent.height, 1 },
    };
}

void rg_cmd_copy_image_to_buffer(struct rg_cmd *cmd, const struct rg_image *image,
                                 const struct rg_buffer *buffer, VkDeviceSize offset)
{
    const struct rg_plan_use *from = find_use(cmd, image, RG_COPY_SRC);
    const struct rg_plan_use *to = find_use(cmd, buffer, RG_COPY_DST);
    assert(from && to); /* the row names both */
    const VkBufferImageCopy region = copy_region(cmd, from, offset);
    cmd->exec->vk.CmdCopyImageToBuffer(cmd->commands, cmd->exec->images[from->image], from->layout,
                                       rg_exec_buffer(cmd->exec, to->buffer, cmd->exec->slot), 1,
                                       &region);
}

void rg_cmd_copy_buffer_to_image(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                 VkDeviceSize offset, const struct rg_image *image)
{
    const struct rg_plan_use *from = find_use(cmd, buffer, RG_COPY_SRC);
    const struct rg_plan_use *to = find_use(cmd, image, RG_COPY_DST);
    assert(from && to); /* the row names both */
    const VkBufferImageCopy region = copy_region(cmd, to, offset);
    cmd->exec->vk.CmdCopyBufferToImage(cmd->commands,
                                       rg_exec_buffer(cmd->exec, from->buffer, cmd->exec->slot),
                                       cmd->exec->images[to->image], to->layout, 1, &region);
}

VkCommandBuffer rg_cmd_vulkan(struct rg_cmd *cmd)
{
    return cmd->commands;
}

VkImage rg_cmd_image(const struct rg_cmd *cmd, const struct rg_image *image)
{
    const struct rg_plan_use *use = find_use(cmd, image, RG_ACCESS_NONE);
    assert(use); /* the row names it */
    return cmd->exec->images[use->image];
}

VkBuffer rg_cmd_buffer(const struct rg_cmd *cmd, const struct rg_buffer *buffer)
{
    const struct rg_plan_use *use = find_use(cmd, buffer, RG_ACCESS_NONE);
    assert(use); /* the row names it */
    return rg_exec_buffer(cmd->exec, use->buffer, cmd->exec->slot);
}
