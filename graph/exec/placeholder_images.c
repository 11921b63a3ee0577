/* placeholder_images.c: creates 1x1 images that replace missing sampled images. Each placeholder
 * has the missing image's format and view type, and is cleared before the first frame. */
#include "graph/exec/executor_internal.h"

static bool is_cube(const struct rg_use *use)
{
    const struct rg_range *range = &use->range;
    uint32_t layers = use->image->layers ? use->image->layers : 6;
    uint32_t named = range->layer_count ? range->layer_count : layers - range->layer;
    return use->image->cube && !range->each && named == 6;
}

static VkResult make_fallback(struct rg_exec *exec, uint32_t index)
{
    struct exec_fallback *fallback = &exec->fallbacks[index];
    const struct rg_use *use = exec->plan->fallbacks[index];
    const struct rg_format_info *format = rg_format_info(use->image->format);
    bool cube = is_cube(use);
    bool array = use->image->layers > 1 || use->image->cube || use->image->array;
    VkResult result;
    fallback->described = (struct rg_plan_image){
        .image = use->image,
        .extent = { 1, 1 },
        .depth = 1,
        .layers = cube ? 6 : 1,
        .mips = 1,
        .aspects = format->aspects,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .flags = cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0,
        .samples = 1,
        .partner = RG_NONE,
        .block = RG_NONE,
    };
    VkImageSubresourceRange subresource = rg_exec_full_range(&fallback->described);
    if (use->range.aspect)
        subresource.aspectMask = use->range.aspect;
    RG_TRY(rg_exec_make_image(exec, &fallback->described, use, &fallback->image));
    fallback->first = exec->found != RG_FOUND_HERE;
    const struct exec_view view = {
        .type = use->image->depth ? VK_IMAGE_VIEW_TYPE_3D
                : cube            ? VK_IMAGE_VIEW_TYPE_CUBE
                : array           ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                  : VK_IMAGE_VIEW_TYPE_2D,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
        .range = subresource,
    };
    RG_TRY(rg_exec_make_view(exec, &fallback->described, fallback->image, &view, &fallback->view));
fail:
    return result;
}

VkResult rg_exec_make_fallbacks(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < exec->plan->fallback_count && result == VK_SUCCESS; i++)
        result = make_fallback(exec, i);
    return result;
}

static VkClearColorValue color_of(const struct rg_use *use)
{
    const float *color = use->fallback->color;
    const struct rg_format_info *format = rg_format_info(use->image->format);
    VkClearColorValue value;
    for (uint32_t i = 0; i < 4; i++) {
        if (format->is_uint)
            value.uint32[i] = (uint32_t)color[i];
        else if (format->is_sint)
            value.int32[i] = (int32_t)color[i];
        else
            value.float32[i] = color[i];
    }
    return value;
}

void rg_exec_record_fallbacks(struct rg_exec *exec, VkCommandBuffer commands)
{
    for (uint32_t i = 0; i < exec->plan->fallback_count; i++) {
        const struct exec_fallback *fallback = &exec->fallbacks[i];
        const VkImageSubresourceRange all = rg_exec_full_range(&fallback->described);
        const VkClearColorValue color = color_of(exec->plan->fallbacks[i]);
        if (!fallback->first)
            continue;
        rg_exec_record_clear_image(exec, commands, fallback->image, &all, &color);
        rg_exec_record_transition(exec, commands, fallback->image, &all,
                                  VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                  VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
}
