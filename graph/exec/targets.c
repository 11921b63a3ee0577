/*
 * targets.c: views of targets, and VkRenderPass objects where rg_exec_params asks for them.
 *
 * The plan's barriers do all synchronisation; a render pass here has one subpass, no dependency
 * and no change of layout, so that both ways of recording mean the same.
 */
#include "graph/exec/exec.h"

/* An attachment: a target, or the image that one resolves to. */
struct attachment {
    uint32_t image, mip, layer;
    const struct rg_plan_target *target; /* NULL: resolved to */
};

static struct attachment target_attachment(const struct rg_plan_target *target)
{
    return (struct attachment){ target->image, target->mip, target->layer, target };
}

/* Lists the attachments of a pass in the order of its views. Returns their number. */
static uint32_t list_attachments(const struct rg_plan_pass *pass,
                                 struct attachment views[RG_VIEW_COUNT])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < pass->color_count; i++)
        views[count++] = target_attachment(&pass->color[i]);
    if (pass->depth.image != RG_NONE)
        views[count++] = target_attachment(&pass->depth);
    for (uint32_t i = 0; i < pass->color_count; i++) {
        const struct rg_plan_target *target = &pass->color[i];
        if (target->resolve != RG_NONE)
            views[count++] = (struct attachment){
                .image = target->resolve,
                .mip = target->resolve_mip,
                .layer = target->resolve_layer,
            };
    }
    return count;
}

VkSampleCountFlagBits rg_exec_samples(const struct rg_exec *exec, const struct rg_plan_pass *pass)
{
    const struct rg_plan_target *target = pass->color_count ? &pass->color[0] : &pass->depth;
    return (VkSampleCountFlagBits)exec->plan->images[target->image].samples;
}

static VkResult make_view(struct rg_exec *exec, const struct attachment *shown, VkImageView *view)
{
    const struct rg_plan_image *image = &exec->plan->images[shown->image];
    VkResult result;
    RG_MAKE(exec, image->image->name, CreateImageView, view,
            &(VkImageViewCreateInfo){
                .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                .image = exec->images[shown->image],
                .viewType = VK_IMAGE_VIEW_TYPE_2D,
                .format = image->image->format,
                .subresourceRange = { image->aspects, shown->mip, 1, shown->layer, 1 },
            });
    rg_exec_name(exec, VK_OBJECT_TYPE_IMAGE_VIEW, (uint64_t)*view, image->image->name);
fail:
    return result;
}

/* A resolve overwrites all of its image, so that nothing is loaded. */
static VkAttachmentDescription describe(const struct rg_exec *exec, const struct attachment *shown)
{
    const struct rg_plan_target resolved = {
        .load = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        .store = VK_ATTACHMENT_STORE_OP_STORE,
        .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
    };
    const struct rg_plan_image *image = &exec->plan->images[shown->image];
    const struct rg_plan_target *target = shown->target ? shown->target : &resolved;
    return (VkAttachmentDescription){
        .format = image->image->format,
        .samples = (VkSampleCountFlagBits)image->samples,
        .loadOp = target->load,
        .storeOp = target->store,
        .stencilLoadOp = target->load,
        .stencilStoreOp = target->store,
        .initialLayout = target->layout,
        .finalLayout = target->layout,
    };
}

static VkResult make_render_pass(struct rg_exec *exec, const struct rg_plan_pass *plan,
                                 struct exec_pass *pass)
{
    struct attachment views[RG_VIEW_COUNT];
    VkAttachmentDescription attachments[RG_VIEW_COUNT];
    VkAttachmentReference references[RG_VIEW_COUNT];
    VkAttachmentReference resolves[RG_COLOR_COUNT];
    bool has_depth = plan->depth.image != RG_NONE;
    uint32_t count = list_attachments(plan, views);
    uint32_t resolve = plan->color_count + has_depth;
    VkResult result;
    for (uint32_t i = 0; i < count; i++) {
        attachments[i] = describe(exec, &views[i]);
        references[i] = (VkAttachmentReference){ i, attachments[i].initialLayout };
    }
    for (uint32_t i = 0; i < plan->color_count; i++) {
        bool resolved = plan->color[i].resolve != RG_NONE;
        resolves[i] = resolved ? references[resolve++]
                               : (VkAttachmentReference){ .attachment = VK_ATTACHMENT_UNUSED };
    }
    const VkSubpassDescription subpass = {
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = plan->color_count,
        .pColorAttachments = references,
        .pResolveAttachments = resolves,
        .pDepthStencilAttachment = has_depth ? &references[plan->color_count] : NULL,
    };
    RG_MAKE(exec, plan->pass->name, CreateRenderPass, &pass->render_pass,
            &(VkRenderPassCreateInfo){
                .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                .attachmentCount = count,
                .pAttachments = attachments,
                .subpassCount = 1,
                .pSubpasses = &subpass,
            });
fail:
    return result;
}

static VkResult make_framebuffer(struct rg_exec *exec, const struct rg_plan_pass *plan,
                                 const struct exec_pass *pass, uint32_t count)
{
    struct exec_targets *targets = rg_exec_targets(exec, pass);
    VkResult result;
    RG_MAKE(exec, plan->pass->name, CreateFramebuffer, &targets->framebuffer,
            &(VkFramebufferCreateInfo){
                .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                .renderPass = pass->render_pass,
                .attachmentCount = count,
                .pAttachments = targets->views,
                .width = plan->extent.width,
                .height = plan->extent.height,
                .layers = 1,
            });
fail:
    return result;
}

/* Makes the views and the framebuffer for the image set in use. */
static VkResult make_targets(struct rg_exec *exec, const struct rg_plan_pass *plan,
                             struct exec_pass *pass)
{
    struct attachment views[RG_VIEW_COUNT];
    struct exec_targets *targets = rg_exec_targets(exec, pass);
    uint32_t count = list_attachments(plan, views);
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < count && result == VK_SUCCESS; i++)
        result = make_view(exec, &views[i], &targets->views[i]);
    if (result == VK_SUCCESS && pass->render_pass)
        result = make_framebuffer(exec, plan, pass, count);
    return result;
}

VkResult rg_exec_make_targets(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t p = 0; p < exec->plan->pass_count; p++) {
        const struct rg_plan_pass *plan = &exec->plan->passes[p];
        struct exec_pass *pass = &exec->passes[p];
        if (exec->params.render_passes && plan->pass->kind == RG_RASTER)
            result = make_render_pass(exec, plan, pass);
        for (uint32_t c = 0; c < exec->image_set_count && result == VK_SUCCESS; c++) {
            rg_exec_select_image_set(exec, c);
            result = make_targets(exec, plan, pass);
        }
        if (result != VK_SUCCESS)
            return result;
    }
    return result;
}

void rg_exec_free_targets(struct rg_exec *exec)
{
    for (uint32_t p = 0; p < exec->plan->pass_count; p++) {
        exec->vk.DestroyRenderPass(exec->device, exec->passes[p].render_pass, NULL);
    }
    for (uint32_t t = 0; exec->targets && t < exec->plan->pass_count * exec->image_set_count; t++) {
        exec->vk.DestroyFramebuffer(exec->device, exec->targets[t].framebuffer, NULL);
        for (uint32_t i = 0; i < RG_VIEW_COUNT; i++)
            exec->vk.DestroyImageView(exec->device, exec->targets[t].views[i], NULL);
    }
}
