/*
 * fallback.c: the executor's own image of one texel for each use that is bound to its fallback.
 *
 * It has the format, and the kind of view, of the image that nothing provides. It is cleared before
 * the first frame and only sampled from then on.
 */
#include <string.h>
#include "graph/exec/exec.h"

static uint32_t layers_of(const struct rg_image *image)
{
    return image->layers ? image->layers : image->cube ? 6 : 1;
}

/* Returns the type that a view of the use's image would have. */
static VkImageViewType view_type(const struct rg_use *use)
{
    const struct rg_range *range = &use->range;
    uint32_t layers = layers_of(use->image);
    uint32_t count = range->each          ? 1
                     : range->layer_count ? range->layer_count
                                          : layers - range->layer;
    if (use->image->cube && count == 6)
        return VK_IMAGE_VIEW_TYPE_CUBE;
    return layers > 1 || use->image->array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
}

static VkImageSubresourceRange range_of(const struct rg_use *use, VkImageAspectFlags aspects)
{
    bool cube = view_type(use) == VK_IMAGE_VIEW_TYPE_CUBE;
    return (VkImageSubresourceRange){ aspects, 0, 1, 0, cube ? 6 : 1 };
}

static bool is_alike(const struct rg_use *a, const struct rg_use *b)
{
    return a->image == b->image && a->fallback == b->fallback &&
           a->range.aspect == b->range.aspect && view_type(a) == view_type(b);
}

/* Returns the first use that can have the same image and view; it may be the use itself. */
static uint32_t find_alike(const struct rg_exec *exec, uint32_t index)
{
    const struct rg_use *const *uses = exec->plan->fallbacks;
    uint32_t i = 0;
    while (i < index && !is_alike(uses[i], uses[index]))
        i++;
    return i;
}

static VkResult make_fallback(struct rg_exec *exec, const struct rg_use *use,
                              struct exec_fallback *fallback)
{
    const char *name = use->image->name;
    const VkImageAspectFlags aspects = rg_format_info(use->image->format)->aspects;
    const VkImageSubresourceRange all = range_of(use, aspects);
    VkMemoryRequirements needs;
    VkResult result;
    RG_MAKE(exec, name, CreateImage, &fallback->image,
            &(VkImageCreateInfo){
                .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                .flags = all.layerCount == 6 ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0,
                .imageType = VK_IMAGE_TYPE_2D,
                .format = use->image->format,
                .extent = { 1, 1, 1 },
                .mipLevels = 1,
                .arrayLayers = all.layerCount,
                .samples = VK_SAMPLE_COUNT_1_BIT,
                .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
            });
    rg_exec_name(exec, VK_OBJECT_TYPE_IMAGE, (uint64_t)fallback->image, name);
    exec->vk.GetImageMemoryRequirements(exec->device, fallback->image, &needs);
    RG_PASS(rg_exec_allocate(exec, &needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, name,
                             &fallback->memory));
    RG_CALL(exec, name, BindImageMemory, exec->device, fallback->image, fallback->memory, 0);
    RG_MAKE(exec, name, CreateImageView, &fallback->view,
            &(VkImageViewCreateInfo){
                .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                .image = fallback->image,
                .viewType = view_type(use),
                .format = use->image->format,
                .subresourceRange = range_of(use, use->range.aspect ? use->range.aspect : aspects),
            });
    rg_exec_name(exec, VK_OBJECT_TYPE_IMAGE_VIEW, (uint64_t)fallback->view, name);
fail:
    return result;
}

VkResult rg_exec_make_fallbacks(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < exec->plan->fallback_count && result == VK_SUCCESS; i++) {
        exec->fallbacks[i] = exec->fallbacks[find_alike(exec, i)];
        exec->fallbacks[i].owner = !exec->fallbacks[i].image;
        if (exec->fallbacks[i].owner)
            result = make_fallback(exec, exec->plan->fallbacks[i], &exec->fallbacks[i]);
    }
    return result;
}

void rg_exec_free_fallbacks(struct rg_exec *exec)
{
    for (uint32_t i = 0; exec->fallbacks && i < exec->plan->fallback_count; i++) {
        const struct exec_fallback *fallback = &exec->fallbacks[i];
        if (!fallback->owner)
            continue;
        exec->vk.DestroyImageView(exec->device, fallback->view, NULL);
        exec->vk.DestroyImage(exec->device, fallback->image, NULL);
        exec->vk.FreeMemory(exec->device, fallback->memory, NULL);
    }
}

/* ---- content ---- */

static VkClearColorValue color_of(const struct rg_use *use)
{
    const float *color = use->fallback->color;
    const char *format = rg_format_info(use->image->format)->name;
    VkClearColorValue value;
    for (uint32_t i = 0; i < 4; i++) {
        if (strstr(format, "_UINT"))
            value.uint32[i] = (uint32_t)color[i];
        else if (strstr(format, "_SINT"))
            value.int32[i] = (int32_t)color[i];
        else
            value.float32[i] = color[i];
    }
    return value;
}

void rg_exec_record_fallbacks(struct rg_exec *exec, VkCommandBuffer commands)
{
    for (uint32_t i = 0; i < exec->plan->fallback_count; i++) {
        const struct rg_use *use = exec->plan->fallbacks[i];
        VkImage image = exec->fallbacks[i].image;
        const VkClearColorValue color = color_of(use);
        const VkImageSubresourceRange all =
            range_of(use, rg_format_info(use->image->format)->aspects);
        if (!exec->fallbacks[i].owner)
            continue;
        rg_exec_record_clear_image(exec, commands, image, &all, &color);
        rg_exec_record_move(exec, commands, image, &all, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
}

void rg_exec_discard_fallback(const struct rg_exec *exec, VkCommandBuffer commands, uint32_t index)
{
    const struct rg_use *use = exec->plan->fallbacks[index];
    const VkImageSubresourceRange all = range_of(use, rg_format_info(use->image->format)->aspects);
    rg_exec_record_move(exec, commands, exec->fallbacks[index].image, &all,
                        VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}
