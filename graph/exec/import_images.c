/*
 * import_images.c: imports that are several images, of which each frame uses one.
 *
 * An image set is the images of one index. Views, framebuffers and descriptor sets are made for
 * every image set beforehand, so that a frame allocates nothing.
 */
#include <assert.h>
#include "graph/exec/exec.h"

VkResult rg_exec_count_image_sets(struct rg_exec *exec)
{
    exec->image_set_count = 1;
    for (size_t i = 0; i < exec->params.import_count; i++) {
        uint32_t count = exec->params.imports[i].image_count;
        if (count && exec->image_set_count > 1 && count != exec->image_set_count)
            return rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED, "the image index",
                                 "imports of different numbers of images");
        if (count)
            exec->image_set_count = count;
    }
    return VK_SUCCESS;
}

void rg_exec_keep_import_images(struct rg_exec *exec, uint32_t image,
                                const struct rg_exec_import *import)
{
    for (uint32_t i = 0; i < import->image_count; i++)
        exec->import_images[i * exec->plan->image_count + image] = import->images[i];
}

void rg_exec_select_image_set(struct rg_exec *exec, uint32_t set)
{
    assert(set < exec->image_set_count);
    exec->image_set = set;
    for (uint32_t i = 0; i < exec->plan->image_count; i++) {
        VkImage image = exec->import_images[set * exec->plan->image_count + i];
        if (image)
            exec->images[i] = image;
    }
}

struct exec_targets *rg_exec_targets(const struct rg_exec *exec, const struct exec_pass *pass)
{
    return &exec->targets[(size_t)exec->image_set * exec->plan->pass_count +
                          (size_t)(pass - exec->passes)];
}

VkDescriptorSet *rg_exec_set(const struct rg_exec *exec, const struct exec_pass *pass,
                             uint32_t slot)
{
    return &pass->sets[exec->image_set * exec->slot_count + slot];
}

VkImageView *rg_exec_use_view(const struct rg_exec *exec, uint32_t use)
{
    return &exec->use_views[exec->image_set * exec->plan->use_count + use];
}
