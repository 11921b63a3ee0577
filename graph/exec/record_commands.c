/* record_commands.c: records the command buffer of a frame; implements rg_cmd.h. */
#include <assert.h>
#include "graph/exec/executor_internal.h"
#include "graph/rg_cmd.h"

/* ---- render passes ---- */

static VkResolveModeFlagBits resolve_mode(const struct rg_plan_image *image)
{
    const struct rg_format_info *format = rg_format_info(image->image->format);
    return format->is_uint || format->is_sint ? VK_RESOLVE_MODE_SAMPLE_ZERO_BIT
                                              : VK_RESOLVE_MODE_AVERAGE_BIT;
}

static void begin_rendering(const struct rg_cmd *cmd)
{
    const struct rg_plan_pass *plan = cmd->plan_pass;
    const struct rg_plan_image *images = cmd->exec->plan->images;
    const VkImageView *views = cmd->exec->image_set->targets[cmd->index].views;
    struct rg_plan_target targets[RG_ATTACHMENT_COUNT];
    VkRenderingAttachmentInfo attachments[RG_COLOR_COUNT + 1];
    uint32_t color_count = plan->color_count;
    bool has_depth = plan->depth.image != RG_NONE;
    uint32_t resolve = color_count + has_depth; /* index of the next resolve target */
    rg_exec_attachments(plan, targets);
    for (uint32_t i = 0; i < color_count + has_depth; i++) {
        const struct rg_target *row = i < color_count ? &plan->pass->color[i] : &plan->pass->depth;
        attachments[i] = (VkRenderingAttachmentInfo){
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = views[i],
            .imageLayout = targets[i].layout,
            .loadOp = targets[i].load,
            .storeOp = targets[i].store,
            .clearValue = row->clear,
        };
        if (i == color_count || targets[i].resolve == RG_NONE)
            continue;
        attachments[i].resolveMode = resolve_mode(&images[targets[i].resolve]);
        attachments[i].resolveImageLayout = targets[resolve].layout;
        attachments[i].resolveImageView = views[resolve++];
    }
    bool has_stencil = has_depth && images[plan->depth.image].aspects & VK_IMAGE_ASPECT_STENCIL_BIT;
    const VkRenderingInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .flags = plan->pass->secondary ? VK_RENDERING_CONTENTS_SECONDARY_COMMAND_BUFFERS_BIT : 0,
        .renderArea = cmd->area,
        .layerCount = 1,
        .colorAttachmentCount = color_count,
        .pColorAttachments = attachments,
        .pDepthAttachment = has_depth ? &attachments[color_count] : NULL,
        .pStencilAttachment = has_stencil ? &attachments[color_count] : NULL,
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
        .framebuffer = cmd->exec->image_set->targets[cmd->index].framebuffer,
        .renderArea = cmd->area,
        .clearValueCount = plan->color_count + 1,
        .pClearValues = clears,
    };
    cmd->exec->vk.CmdBeginRenderPass(cmd->commands, &info,
                                     plan->pass->secondary
                                         ? VK_SUBPASS_CONTENTS_SECONDARY_COMMAND_BUFFERS
                                         : VK_SUBPASS_CONTENTS_INLINE);
}

void rg_exec_bind(const struct rg_cmd *cmd)
{
    const struct rg_plan_pass *plan = cmd->plan_pass;
    VkPipelineBindPoint point = plan->pass->kind == RG_COMPUTE ? VK_PIPELINE_BIND_POINT_COMPUTE
                                                               : VK_PIPELINE_BIND_POINT_GRAPHICS;
    if (plan->pass->kind == RG_TRANSFER)
        return;
    cmd->exec->vk.CmdBindPipeline(cmd->commands, point, cmd->pass->pipeline);
    const VkDescriptorSet *sets = cmd->exec->image_set->descriptors[cmd->index];
    cmd->exec->vk.CmdBindDescriptorSets(cmd->commands, point, cmd->pass->layout, 0, 1,
                                        &sets[cmd->exec->slot], 0, NULL);
    if (plan->pass->kind != RG_RASTER)
        return;
    const VkViewport viewport = {
        .width = (float)plan->extent.width,
        .height = (float)plan->extent.height,
        .maxDepth = 1.0f,
    };
    cmd->exec->vk.CmdSetViewport(cmd->commands, 0, 1, &viewport);
    cmd->exec->vk.CmdSetScissor(cmd->commands, 0, 1, &cmd->area);
}

/* Advances `cmd` to the next pass that is declared by `row` and has the same repetition index. */
static void skip_to(struct rg_cmd *cmd, const struct rg_pass *row)
{
    const struct rg_plan *plan = cmd->exec->plan;
    const uint32_t repetition = cmd->plan_pass->repetition;
    do {
        cmd->index++;
        assert(cmd->index < plan->pass_count);
        cmd->plan_pass = &plan->passes[cmd->index];
    } while (cmd->plan_pass->pass != row || cmd->plan_pass->repetition != repetition);
    cmd->pass = &cmd->exec->passes[cmd->index];
}

/* Records the passes merged by rg_more_fn into the current one, each with its own descriptors. */
static void record_merged_rows(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    struct rg_cmd other = *cmd;
    const struct rg_pass *row = cmd->plan_pass->pass;
    while (row->more && (row = row->more(row, frame))) {
        skip_to(&other, row);
        rg_exec_bind(&other);
        row->record(&other, frame);
    }
}

/* Records a pass without its barriers. */
static void record_work(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    bool raster = cmd->plan_pass->pass->kind == RG_RASTER;
    if (raster && cmd->pass->render_pass)
        begin_render_pass(cmd);
    else if (raster)
        begin_rendering(cmd);
    if (!cmd->plan_pass->pass->secondary)
        rg_exec_bind(cmd);
    cmd->plan_pass->pass->record(cmd, frame);
    record_merged_rows(cmd, frame);
    if (raster && cmd->pass->render_pass)
        cmd->exec->vk.CmdEndRenderPass(cmd->commands);
    else if (raster)
        cmd->exec->vk.CmdEndRendering(cmd->commands);
}

/* Returns true if the pass runs in this frame and its area is not empty; sets cmd->area. */
static bool is_drawn(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct rg_pass *row = cmd->plan_pass->pass;
    if (row->when && !row->when(frame, cmd->plan_pass->repetition))
        return false;
    cmd->area = rg_exec_area(cmd);
    if (!row->area)
        return true;
    cmd->area = rg_exec_intersect(row->area(cmd, frame), cmd->area);
    return cmd->area.extent.width && cmd->area.extent.height;
}

static struct rg_cmd begin_pass(struct rg_exec *exec, uint32_t index, VkCommandBuffer commands)
{
    return (struct rg_cmd){
        .exec = exec,
        .index = index,
        .plan_pass = &exec->plan->passes[index],
        .pass = &exec->passes[index],
        .commands = commands,
    };
}

VkRect2D rg_exec_pass_area(struct rg_exec *exec, uint32_t index, const struct rg_frame *frame)
{
    struct rg_cmd cmd = begin_pass(exec, index, VK_NULL_HANDLE);
    return is_drawn(&cmd, frame) ? cmd.area : (VkRect2D){ 0 };
}

/* Limits the render area to the rows of a part. Returns false if none is left. */
static bool limit_rows(struct rg_cmd *cmd, const struct exec_part *part)
{
    const VkRect2D band = { { cmd->area.offset.x, (int32_t)part->row },
                            { cmd->area.extent.width, part->row_end - part->row } };
    if (part->row_end)
        cmd->area = rg_exec_intersect(band, cmd->area);
    return cmd->area.extent.height;
}

static void record_pass(struct rg_exec *exec, uint32_t index, VkCommandBuffer commands,
                        const struct rg_frame *frame, const struct exec_part *part)
{
    struct rg_cmd cmd = begin_pass(exec, index, commands);
    const struct rg_pass *row = cmd.plan_pass->pass;
    if (exec->vk.CmdBeginDebugUtilsLabelEXT)
        exec->vk.CmdBeginDebugUtilsLabelEXT(commands,
                                            &(VkDebugUtilsLabelEXT){
                                                .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                                .pLabelName = row->name,
                                            });
    if (part->begins) {
        rg_time_begin_pass(exec, commands, index);
        rg_exec_add_batch(exec, commands, cmd.plan_pass->first_barrier,
                          cmd.plan_pass->barrier_count);
    }
    const bool drawn = !part->is_empty && is_drawn(&cmd, frame) && limit_rows(&cmd, part);
    if (drawn) {
        rg_exec_record_batch(exec, commands);
        record_work(&cmd, frame);
    }
    if (part->ends)
        rg_time_end_pass(exec, commands, index, drawn);
    if (exec->vk.CmdEndDebugUtilsLabelEXT)
        exec->vk.CmdEndDebugUtilsLabelEXT(commands);
}

VkResult rg_exec_record_part(struct rg_exec *exec, VkCommandBuffer commands,
                             const struct rg_frame *frame, const struct exec_part *part)
{
    const struct rg_plan *plan = exec->plan;
    const bool is_first = part->first == 0 && part->begins;
    if (is_first && !exec->initialized) {
        rg_exec_record_clear(exec, commands);
        rg_exec_record_fallbacks(exec, commands);
    }
    if (is_first)
        rg_time_begin_frame(exec, commands);
    for (uint32_t p = part->first; p < part->first + part->count; p++)
        record_pass(exec, p, commands, frame, part);
    if (part->ends && part->first + part->count == plan->pass_count)
        rg_exec_add_batch(exec, commands, plan->first_final_barrier, plan->final_barrier_count);
    rg_exec_record_batch(exec, commands);
    return exec->record_result;
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

void rg_cmd_bind_set(struct rg_cmd *cmd, VkDescriptorSet set)
{
    const VkPipelineBindPoint point = cmd->plan_pass->pass->kind == RG_COMPUTE
                                          ? VK_PIPELINE_BIND_POINT_COMPUTE
                                          : VK_PIPELINE_BIND_POINT_GRAPHICS;
    cmd->exec->vk.CmdBindDescriptorSets(cmd->commands, point, cmd->pass->layout, 1, 1, &set, 0,
                                        NULL);
}

void rg_cmd_draw(struct rg_cmd *cmd, uint32_t vertex_count)
{
    rg_cmd_draw_instances(cmd, vertex_count, 1);
}

void rg_cmd_draw_instances(struct rg_cmd *cmd, uint32_t vertex_count, uint32_t instance_count)
{
    cmd->exec->vk.CmdDraw(cmd->commands, vertex_count, instance_count, 0, 0);
}

static void bind_mesh(const struct rg_cmd *cmd, const struct rg_mesh *mesh)
{
    const struct rg_exec *exec = cmd->exec;
    const VkDeviceSize offset = 0;
    const struct rg_vertex_layout *layout = cmd->plan_pass->pass->vertices;
    for (uint32_t i = 0; layout; layout = layout->next, i++) {
        const VkBuffer *buffer = i ? &mesh->more[i - 1] : &mesh->vertices;
        exec->vk.CmdBindVertexBuffers(cmd->commands, i, 1, buffer, &offset);
    }
    exec->vk.CmdBindIndexBuffer(cmd->commands, mesh->indices, 0, VK_INDEX_TYPE_UINT32);
}

void rg_cmd_draw_mesh_part(struct rg_cmd *cmd, const struct rg_mesh *mesh, uint32_t first,
                           uint32_t count)
{
    if (!count)
        return;
    bind_mesh(cmd, mesh);
    const uint32_t instance_count = mesh->instance_count ? mesh->instance_count : 1;
    cmd->exec->vk.CmdDrawIndexed(cmd->commands, count, instance_count, first, 0, 0);
}

void rg_cmd_draw_mesh(struct rg_cmd *cmd, const struct rg_mesh *mesh)
{
    rg_cmd_draw_mesh_part(cmd, mesh, 0, mesh->index_count);
}

void rg_cmd_scissor(struct rg_cmd *cmd, VkRect2D rectangle)
{
    const VkRect2D both = rg_exec_intersect(rectangle, cmd->area);
    cmd->exec->vk.CmdSetScissor(cmd->commands, 0, 1, &both);
}

void rg_cmd_dispatch(struct rg_cmd *cmd, uint32_t x, uint32_t y, uint32_t z)
{
    cmd->exec->vk.CmdDispatch(cmd->commands, x, y, z);
}

/* Returns the pass's first use of a resource by `access`, where 0 stands for any access. */
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
    assert(false); /* the row must declare the resource */
    return NULL;
}

static VkBuffer find_buffer(const struct rg_cmd *cmd, const struct rg_buffer *buffer,
                            enum rg_access access)
{
    const struct rg_plan_use *use = find_use(cmd, buffer, access);
    return rg_exec_buffer(cmd->exec, use->buffer, cmd->exec->slot)->buffer;
}

void rg_cmd_draw_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer, VkDeviceSize offset)
{
    cmd->exec->vk.CmdDrawIndirect(cmd->commands, find_buffer(cmd, buffer, RG_INDIRECT), offset, 1,
                                  0);
}

void rg_cmd_draw_mesh_indirect(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                               const struct rg_buffer *buffer, VkDeviceSize offset)
{
    bind_mesh(cmd, mesh);
    cmd->exec->vk.CmdDrawIndexedIndirect(cmd->commands, find_buffer(cmd, buffer, RG_INDIRECT),
                                         offset, 1, 0);
}

/* Returns true if the device supports indirect counts; otherwise rg_exec_submit() will fail. */
static bool has_indirect_count(const struct rg_cmd *cmd)
{
    struct rg_exec *exec = cmd->exec;
    if (!exec->has_indirect_count)
        exec->record_result =
            rg_exec_check(exec, VK_ERROR_FEATURE_NOT_PRESENT, "the feature drawIndirectCount",
                          cmd->plan_pass->pass->name);
    return exec->has_indirect_count;
}

void rg_cmd_draw_indirect_count(struct rg_cmd *cmd, const struct rg_indirect_count *draws)
{
    if (has_indirect_count(cmd))
        cmd->exec->vk.CmdDrawIndirectCount(
            cmd->commands, find_buffer(cmd, draws->commands, RG_INDIRECT), draws->offset,
            find_buffer(cmd, draws->count, RG_INDIRECT), draws->count_offset, draws->max_count,
            sizeof(VkDrawIndirectCommand));
}

void rg_cmd_draw_mesh_indirect_count(struct rg_cmd *cmd, const struct rg_mesh *mesh,
                                     const struct rg_indirect_count *draws)
{
    bind_mesh(cmd, mesh);
    if (has_indirect_count(cmd))
        cmd->exec->vk.CmdDrawIndexedIndirectCount(
            cmd->commands, find_buffer(cmd, draws->commands, RG_INDIRECT), draws->offset,
            find_buffer(cmd, draws->count, RG_INDIRECT), draws->count_offset, draws->max_count,
            sizeof(VkDrawIndexedIndirectCommand));
}

void rg_cmd_dispatch_indirect(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                              VkDeviceSize offset)
{
    cmd->exec->vk.CmdDispatchIndirect(cmd->commands, find_buffer(cmd, buffer, RG_INDIRECT), offset);
}

static VkBufferImageCopy copy_region(const struct rg_cmd *cmd, const struct rg_plan_use *use,
                                     VkDeviceSize offset)
{
    const struct rg_plan_image *image = &cmd->exec->plan->images[use->image];
    uint32_t mip = use->range.baseMipLevel;
    uint32_t width = image->extent.width >> mip;
    uint32_t height = image->extent.height >> mip;
    uint32_t depth = image->depth >> mip;
    const VkRect2D whole = { .extent = { width ? width : 1, height ? height : 1 } };
    const VkRect2D area = rg_exec_is_limited(cmd) ? cmd->exec->region.region : whole;
    return (VkBufferImageCopy){
        .bufferOffset = offset,
        .imageSubresource = { use->range.aspectMask, mip, use->range.baseArrayLayer,
                              use->range.layerCount },
        .imageOffset = { area.offset.x, area.offset.y, 0 },
        .imageExtent = { area.extent.width, area.extent.height, depth ? depth : 1 },
    };
}

/* Returns true if a copy stays within the buffer; otherwise rg_exec_submit() will fail. */
static bool copy_fits(const struct rg_cmd *cmd, const struct rg_plan_use *image,
                      const struct rg_plan_use *buffer, const VkBufferImageCopy *region)
{
    struct rg_exec *exec = cmd->exec;
    const struct rg_plan_buffer *to = &exec->plan->buffers[buffer->buffer];
    const struct rg_format_info *format =
        rg_format_info(exec->plan->images[image->image].image->format);
    VkDeviceSize texel = image->range.aspectMask == VK_IMAGE_ASPECT_STENCIL_BIT ? 1
                         : format->aspects & VK_IMAGE_ASPECT_STENCIL_BIT        ? 4
                                                                                : format->size;
    VkDeviceSize size = texel * region->imageExtent.width * region->imageExtent.height *
                        region->imageExtent.depth * region->imageSubresource.layerCount;
    char what[256];
    if (size <= to->size && region->bufferOffset <= to->size - size)
        return true;
    snprintf(what, sizeof(what), "%s: copy of %llu bytes at offset %llu exceeds the %llu bytes",
             cmd->plan_pass->pass->name, (unsigned long long)size,
             (unsigned long long)region->bufferOffset, (unsigned long long)to->size);
    exec->record_result =
        rg_exec_check(exec, VK_ERROR_VALIDATION_FAILED_EXT, what, to->buffer->name);
    return false;
}

void rg_cmd_copy_image_to_buffer(struct rg_cmd *cmd, const struct rg_image *image,
                                 const struct rg_buffer *buffer, VkDeviceSize offset)
{
    const struct rg_plan_use *from = find_use(cmd, image, RG_COPY_SRC);
    const struct rg_plan_use *to = find_use(cmd, buffer, RG_COPY_DST);
    const VkBufferImageCopy region = copy_region(cmd, from, offset);
    if (copy_fits(cmd, from, to, &region))
        cmd->exec->vk.CmdCopyImageToBuffer(
            cmd->commands, cmd->exec->image_set->images[from->image], from->layout,
            rg_exec_buffer(cmd->exec, to->buffer, cmd->exec->slot)->buffer, 1, &region);
}

void rg_cmd_copy_buffer_to_image(struct rg_cmd *cmd, const struct rg_buffer *buffer,
                                 VkDeviceSize offset, const struct rg_image *image)
{
    const struct rg_plan_use *to = find_use(cmd, image, RG_COPY_DST);
    const struct rg_plan_use *from = find_use(cmd, buffer, RG_COPY_SRC);
    const VkBufferImageCopy region = copy_region(cmd, to, offset);
    if (copy_fits(cmd, to, from, &region))
        cmd->exec->vk.CmdCopyBufferToImage(
            cmd->commands, rg_exec_buffer(cmd->exec, from->buffer, cmd->exec->slot)->buffer,
            cmd->exec->image_set->images[to->image], to->layout, 1, &region);
}

VkCommandBuffer rg_cmd_vulkan(struct rg_cmd *cmd)
{
    return cmd->commands;
}

VkImage rg_cmd_image(const struct rg_cmd *cmd, const struct rg_image *image)
{
    return cmd->exec->image_set->images[find_use(cmd, image, RG_ACCESS_NONE)->image];
}

VkBuffer rg_cmd_buffer(const struct rg_cmd *cmd, const struct rg_buffer *buffer)
{
    return find_buffer(cmd, buffer, RG_ACCESS_NONE);
}
