/* record_commands.c: records the command buffer of a frame. */
#include "graph/exec/executor_internal.h"

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
        .layerCount = rg_exec_layers(plan->pass),
        .viewMask = rg_exec_view_mask(plan->pass),
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
    if (cmd->pass->pipeline)
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

/* Advances `cmd` to the next pass that is declared by `row` and has the same repetition index.
 * Returns false if there is none. */
static bool skip_to(struct rg_cmd *cmd, const struct rg_pass *row)
{
    const struct rg_plan *plan = cmd->exec->plan;
    for (uint32_t i = cmd->index + 1; i < plan->pass_count; i++) {
        if (plan->passes[i].pass != row || plan->passes[i].repetition != cmd->plan_pass->repetition)
            continue;
        cmd->index = i;
        cmd->plan_pass = &plan->passes[i];
        cmd->pass = &cmd->exec->passes[i];
        return true;
    }
    rg_exec_misuse(cmd, row->name, "rg_exec_extensions.more: no later pass");
    return false;
}

/* Records the passes merged by rg_more_fn into the current one, each with its own descriptors. */
static void record_merged_rows(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_more_fn *more = cmd->exec->extensions.more;
    struct rg_cmd other = *cmd;
    const struct rg_pass *row = cmd->plan_pass->pass;
    if (!more || row->kind != RG_RASTER || row->secondary)
        return;
    while ((row = more(row, frame)) && skip_to(&other, row)) {
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
    const struct rg_pass *row = exec->plan->passes[index].pass;
    return (struct rg_cmd){
        .exec = exec,
        .index = index,
        .plan_pass = &exec->plan->passes[index],
        .pass = &exec->passes[index],
        .commands = commands,
        .has_pipeline = exec->passes[index].pipeline,
        .has_push = !row->push_size,
        .has_set = !row->set,
    };
}

VkRect2D rg_exec_pass_area(struct rg_exec *exec, uint32_t index, const struct rg_frame *frame)
{
    struct rg_cmd cmd = begin_pass(exec, index, VK_NULL_HANDLE);
    return is_drawn(&cmd, frame) ? cmd.area : (VkRect2D){ 0 };
}

/* Limits the render area to the rectangle of a part. Returns false if nothing is left. */
static bool limit_area(struct rg_cmd *cmd, const struct exec_part *part)
{
    const VkRect2D rectangle = {
        { (int32_t)part->left, (int32_t)part->row },
        { part->left_end - part->left, part->row_end - part->row },
    };
    if (part->row_end)
        cmd->area = rg_exec_intersect(rectangle, cmd->area);
    return cmd->area.extent.width && cmd->area.extent.height;
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
    const bool drawn = !part->is_empty && is_drawn(&cmd, frame) && limit_area(&cmd, part);
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
    /* of a plan for several queues, the first and the last part have no passes */
    const bool is_boundary = !plan->submission_count || !part->count;
    const bool is_first = part->first == 0 && part->begins && is_boundary;
    exec->record_result = VK_SUCCESS;
    if (is_first && !exec->initialized) {
        rg_exec_record_clear(exec, commands);
        rg_exec_record_fallbacks(exec, commands);
    }
    if (is_first)
        rg_time_begin_frame(exec, commands);
    for (uint32_t p = part->first; p < part->first + part->count; p++)
        record_pass(exec, p, commands, frame, part);
    if (part->ends && part->first + part->count == plan->pass_count && is_boundary)
        rg_exec_add_batch(exec, commands, plan->first_final_barrier, plan->final_barrier_count);
    rg_exec_record_batch(exec, commands);
    return (VkResult)exec->record_result;
}

VkResult rg_exec_record_own(struct rg_exec *exec, VkCommandBuffer commands,
                            const struct rg_frame *frame, const struct exec_part *part)
{
    VkResult result;
    RG_CALL(exec, NULL, BeginCommandBuffer, commands,
            &(VkCommandBufferBeginInfo){
                .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
            });
    (void)rg_exec_record_part(exec, commands, frame, part);
    RG_CALL(exec, NULL, EndCommandBuffer, commands);
    result = (VkResult)exec->record_result;
fail:
    return result;
}
