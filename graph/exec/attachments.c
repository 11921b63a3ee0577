/* attachments.c: creates attachment views and, if requested, VkRenderPass objects. Each render pass
 * has one subpass. The plan's barriers replace subpass dependencies and layout transitions. */
#include "graph/exec/executor_internal.h"

uint32_t rg_exec_attachments(const struct rg_plan_pass *pass,
                             struct rg_plan_target attachments[RG_ATTACHMENT_COUNT])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < pass->color_count; i++)
        attachments[count++] = pass->color[i];
    if (pass->depth.image != RG_NONE)
        attachments[count++] = pass->depth;
    for (uint32_t i = 0; i < pass->color_count; i++) {
        const struct rg_plan_target *target = &pass->color[i];
        if (target->resolve != RG_NONE)
            attachments[count++] = (struct rg_plan_target){
                .image = target->resolve,
                .mip = target->resolve_mip,
                .layer = target->resolve_layer,
                .load = VK_ATTACHMENT_LOAD_OP_DONT_CARE, /* fully overwritten */
                .store = VK_ATTACHMENT_STORE_OP_STORE,
                .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                .resolve = RG_NONE,
            };
    }
    return count;
}

VkSampleCountFlagBits rg_exec_samples(const struct rg_exec *exec, const struct rg_plan_pass *pass)
{
    const struct rg_plan_target *target = pass->color_count ? &pass->color[0] : &pass->depth;
    return (VkSampleCountFlagBits)exec->plan->images[target->image].samples;
}

static VkResult make_render_pass(struct rg_exec *exec, const struct rg_plan_pass *plan,
                                 struct exec_pass *pass)
{
    struct rg_plan_target targets[RG_ATTACHMENT_COUNT];
    VkAttachmentDescription attachments[RG_ATTACHMENT_COUNT];
    VkAttachmentReference references[RG_ATTACHMENT_COUNT];
    VkAttachmentReference resolves[RG_COLOR_COUNT];
    bool has_depth = plan->depth.image != RG_NONE;
    uint32_t count = rg_exec_attachments(plan, targets);
    uint32_t resolve = plan->color_count + has_depth;
    const uint32_t view_mask = rg_exec_view_mask(plan->pass);
    VkResult result;
    RG_KEY(exec, plan->color_count);
    RG_KEY(exec, view_mask);
    for (uint32_t i = 0; i < count; i++) {
        const struct rg_plan_image *image = &exec->plan->images[targets[i].image];
        const uint32_t fields[] = { (uint32_t)image->image->format, image->samples,
                                    (uint32_t)targets[i].load,      (uint32_t)targets[i].store,
                                    (uint32_t)targets[i].layout,    targets[i].resolve != RG_NONE };
        rg_exec_key(exec, fields, sizeof(fields));
        attachments[i] = (VkAttachmentDescription){
            .format = image->image->format,
            .samples = (VkSampleCountFlagBits)image->samples,
            .loadOp = targets[i].load,
            .storeOp = targets[i].store,
            .stencilLoadOp = targets[i].load,
            .stencilStoreOp = targets[i].store,
            .initialLayout = targets[i].layout,
            .finalLayout = targets[i].layout,
        };
        references[i] = (VkAttachmentReference){ i, targets[i].layout };
    }
    for (uint32_t i = 0; i < plan->color_count; i++)
        resolves[i] = plan->color[i].resolve != RG_NONE
                          ? references[resolve++]
                          : (VkAttachmentReference){ .attachment = VK_ATTACHMENT_UNUSED };
    const VkSubpassDescription subpass = {
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = plan->color_count,
        .pColorAttachments = references,
        .pResolveAttachments = resolves,
        .pDepthStencilAttachment = has_depth ? &references[plan->color_count] : NULL,
    };
    const VkRenderPassMultiviewCreateInfo multiview = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_MULTIVIEW_CREATE_INFO,
        .subpassCount = 1,
        .pViewMasks = &view_mask,
    };
    RG_MAKE(exec, plan->pass->name, RENDER_PASS, CreateRenderPass, &pass->render_pass,
            &(VkRenderPassCreateInfo){
                .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                .pNext = view_mask ? &multiview : NULL,
                .attachmentCount = count,
                .pAttachments = attachments,
                .subpassCount = 1,
                .pSubpasses = &subpass,
            });
fail:
    return result;
}

/* Creates the attachment views and framebuffer of a pass, for one set of swapchain images. */
static VkResult make_targets(struct rg_exec *exec, const struct exec_image_set *set, uint32_t index)
{
    const struct rg_plan_pass *plan = &exec->plan->passes[index];
    struct rg_plan_target attachments[RG_ATTACHMENT_COUNT];
    struct exec_targets *targets = &set->targets[index];
    uint32_t count = rg_exec_attachments(plan, attachments);
    const uint32_t view_layers = rg_exec_layers(plan->pass);
    const uint32_t layers = plan->pass->multiview ? 1 : view_layers; /* of the framebuffer */
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < count; i++) {
        const struct rg_plan_target *target = &attachments[i];
        const struct rg_plan_image *image = &exec->plan->images[target->image];
        const struct exec_view view = {
            .type = view_layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D,
            .usage = image->usage & (VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                     VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT),
            .range = { image->aspects, target->mip, 1, target->layer, view_layers },
        };
        RG_TRY(
            rg_exec_make_view(exec, image, set->images[target->image], &view, &targets->views[i]));
    }
    if (!exec->passes[index].render_pass)
        return VK_SUCCESS;
    rg_exec_key(exec, targets->views, count * sizeof(targets->views[0]));
    RG_KEY(exec, exec->passes[index].render_pass);
    RG_KEY(exec, (uint64_t)plan->extent.width << 32 | plan->extent.height);
    RG_KEY(exec, layers);
    RG_MAKE(exec, plan->pass->name, FRAMEBUFFER, CreateFramebuffer, &targets->framebuffer,
            &(VkFramebufferCreateInfo){
                .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                .renderPass = exec->passes[index].render_pass,
                .attachmentCount = count,
                .pAttachments = targets->views,
                .width = plan->extent.width,
                .height = plan->extent.height,
                .layers = layers,
            });
fail:
    return result;
}

VkResult rg_exec_make_targets(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t p = 0; p < exec->plan->pass_count; p++) {
        const struct rg_plan_pass *plan = &exec->plan->passes[p];
        if (exec->extensions.render_passes && plan->pass->kind == RG_RASTER)
            RG_TRY(make_render_pass(exec, plan, &exec->passes[p]));
        for (uint32_t i = 0; i < exec->image_set_count; i++)
            RG_TRY(make_targets(exec, &exec->image_sets[i], p));
    }
fail:
    return result;
}
