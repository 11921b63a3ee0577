/*
 * rg_render_pass.c: views of the targets, and VkRenderPass objects for devices under validation.
 *
 * The plan's barriers do all synchronisation; a render pass here has one subpass, no dependency
 * and no change of layout, so that both ways of recording mean the same.
 */
#include "graph/rg_exec_internal.h"

static uint32_t target_count(const struct rg_plan_pass *pass)
{
    return pass->color_count + (pass->depth.image != RG_NONE);
}

static const struct rg_plan_target *target_at(const struct rg_plan_pass *pass, uint32_t index)
{
    return index < pass->color_count ? &pass->color[index] : &pass->depth;
}

static VkResult make_view(struct rg_exec *exec, const struct rg_plan_target *target,
                          VkImageView *view)
{
    const struct rg_plan_image *image = &exec->plan->images[target->image];
    VkResult result;
    RG_TRY(exec, vkCreateImageView(
                     exec->device,
                     &(VkImageViewCreateInfo){
                         .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                         .image = exec->images[target->image],
                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                         .format = image->image->format,
                         .subresourceRange = { image->aspects, target->mip, 1, target->layer, 1 },
                     },
                     NULL, view));
    rg_exec_name(exec, VK_OBJECT_TYPE_IMAGE_VIEW, (uint64_t)*view, image->image->name);
fail:
    return result;
}

static VkResult make_render_pass(struct rg_exec *exec, const struct rg_plan_pass *plan,
                                 struct exec_pass *pass)
{
    VkAttachmentDescription attachments[RG_COLOR_COUNT + 1];
    VkAttachmentReference references[RG_COLOR_COUNT + 1];
    uint32_t count = target_count(plan);
    VkResult result;
    for (uint32_t i = 0; i < count; i++) {
        const struct rg_plan_target *target = target_at(plan, i);
        attachments[i] = (VkAttachmentDescription){
            .format = exec->plan->images[target->image].image->format,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = target->load,
            .storeOp = target->store,
            .stencilLoadOp = target->load,
            .stencilStoreOp = target->store,
            .initialLayout = target->layout,
            .finalLayout = target->layout,
        };
        references[i] = (VkAttachmentReference){ i, target->layout };
    }
    const VkSubpassDescription subpass = {
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = plan->color_count,
        .pColorAttachments = references,
        .pDepthStencilAttachment = count > plan->color_count ? &references[count - 1] : NULL,
    };
    RG_TRY(exec, vkCreateRenderPass(exec->device,
                                    &(VkRenderPassCreateInfo){
                                        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                        .attachmentCount = count,
                                        .pAttachments = attachments,
                                        .subpassCount = 1,
                                        .pSubpasses = &subpass,
                                    },
                                    NULL, &pass->render_pass));
    RG_TRY(exec, vkCreateFramebuffer(exec->device,
                                     &(VkFramebufferCreateInfo){
                                         .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                         .renderPass = pass->render_pass,
                                         .attachmentCount = count,
                                         .pAttachments = pass->views,
                                         .width = plan->extent.width,
                                         .height = plan->extent.height,
                                         .layers = 1,
                                     },
                                     NULL, &pass->framebuffer));
fail:
    return result;
}

VkResult rg_exec_make_targets(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t p = 0; p < exec->plan->pass_count; p++) {
        const struct rg_plan_pass *plan = &exec->plan->passes[p];
        for (uint32_t i = 0; i < target_count(plan) && result == VK_SUCCESS; i++)
            result = make_view(exec, target_at(plan, i), &exec->passes[p].views[i]);
        if (result == VK_SUCCESS && exec->params.render_passes && plan->pass->kind == RG_RASTER)
            result = make_render_pass(exec, plan, &exec->passes[p]);
    }
    return result;
}

void rg_exec_free_targets(struct rg_exec *exec)
{
    for (uint32_t p = 0; p < exec->plan->pass_count; p++) {
        struct exec_pass *pass = &exec->passes[p];
        vkDestroyFramebuffer(exec->device, pass->framebuffer, NULL);
        vkDestroyRenderPass(exec->device, pass->render_pass, NULL);
        for (uint32_t i = 0; i <= RG_COLOR_COUNT; i++)
            vkDestroyImageView(exec->device, pass->views[i], NULL);
    }
}
