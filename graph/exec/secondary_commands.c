/* secondary_commands.c: records the application's secondary command buffers (rg_cmd.h). */
#include "graph/exec/executor_internal.h"
#include "graph/rg_cmd.h"

/* Returns true if the pass sets rg_pass.secondary; otherwise logs a misuse. */
static bool can_use(const struct rg_cmd *cmd, const char *command)
{
    if (!cmd->plan_pass->pass->secondary)
        rg_exec_misuse(cmd, NULL, "%s needs rg_pass.secondary", command);
    return cmd->plan_pass->pass->secondary;
}

VkResult rg_cmd_record_secondary(const struct rg_cmd *cmd, VkCommandBuffer secondary,
                                 rg_secondary_fn *record, void *user)
{
    const struct rg_exec *exec = cmd->exec;
    const struct rg_pass *row = cmd->plan_pass->pass;
    const bool raster = row->kind == RG_RASTER;
    VkFormat formats[RG_COLOR_COUNT];
    struct rg_cmd part = *cmd;
    VkCommandBufferInheritanceRenderingInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_RENDERING_INFO,
    };
    VkCommandBufferInheritanceInfo inherited = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO,
    };
    VkResult result;
    if (!can_use(cmd, "rg_cmd_record_secondary()"))
        return VK_ERROR_VALIDATION_FAILED_EXT;
    if (raster && cmd->pass->render_pass) {
        inherited.renderPass = cmd->pass->render_pass;
        inherited.framebuffer = exec->image_set->targets[cmd->index].framebuffer;
    } else if (raster) {
        const VkPipelineRenderingCreateInfo targets =
            rg_exec_target_formats(exec, cmd->plan_pass, formats);
        rendering.viewMask = targets.viewMask;
        rendering.colorAttachmentCount = targets.colorAttachmentCount;
        rendering.pColorAttachmentFormats = formats;
        rendering.depthAttachmentFormat = targets.depthAttachmentFormat;
        rendering.stencilAttachmentFormat = targets.stencilAttachmentFormat;
        rendering.rasterizationSamples = rg_exec_samples(exec, cmd->plan_pass);
        inherited.pNext = &rendering;
    }
    const VkCommandBufferBeginInfo begin = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT |
                 (raster ? VK_COMMAND_BUFFER_USAGE_RENDER_PASS_CONTINUE_BIT : 0),
        .pInheritanceInfo = &inherited,
    };
    part.commands = secondary;
    part.is_secondary = true;
    RG_CALL(exec, row->name, BeginCommandBuffer, secondary, &begin);
    rg_exec_bind(&part);
    record(&part, user);
    RG_CALL(exec, row->name, EndCommandBuffer, secondary);
fail:
    return result;
}

void rg_cmd_execute(struct rg_cmd *cmd, const VkCommandBuffer *secondary, uint32_t count)
{
    if (can_use(cmd, "rg_cmd_execute()") && count)
        cmd->exec->vk.CmdExecuteCommands(cmd->commands, count, secondary);
}
