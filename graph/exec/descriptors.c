/* descriptors.c: views, samplers and descriptor set 0 of the uses of each row. */
#include <stdlib.h>
#include <string.h>
#include "graph/exec/exec.h"

static VkDescriptorType descriptor_type(const struct rg_plan_use *use)
{
    const struct rg_access_info *info = rg_access_info(use->use->access);
    return use->image != RG_NONE ? info->image_descriptor : info->buffer_descriptor;
}

static bool has_descriptor(const struct rg_plan_use *use)
{
    return descriptor_type(use) != VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

static VkShaderStageFlags use_stages(const struct rg_pass *pass, const struct rg_use *use)
{
    VkShaderStageFlags stages = 0;
    if (use->stages & VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT)
        stages |= VK_SHADER_STAGE_VERTEX_BIT;
    if (use->stages & VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT)
        stages |= VK_SHADER_STAGE_FRAGMENT_BIT;
    if (use->stages & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT)
        stages |= VK_SHADER_STAGE_COMPUTE_BIT;
    return stages ? stages : rg_exec_stages(pass);
}

static VkImageViewType view_type(const struct rg_plan_image *image, const struct rg_plan_use *use)
{
    bool storage = use->use->access != RG_SAMPLED;
    if (image->image->cube && !storage && use->range.layerCount == 6)
        return VK_IMAGE_VIEW_TYPE_CUBE;
    if (image->layers > 1 || image->image->array)
        return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    return VK_IMAGE_VIEW_TYPE_2D;
}

static VkResult make_use_view(struct rg_exec *exec, uint32_t index)
{
    const struct rg_plan_use *use = &exec->plan->uses[index];
    VkImageView *view = rg_exec_use_view(exec, index);
    VkResult result = VK_SUCCESS;
    if (use->image == RG_NONE || !has_descriptor(use))
        return VK_SUCCESS;
    const struct rg_plan_image *image = &exec->plan->images[use->image];
    RG_MAKE(exec, image->image->name, CreateImageView, view,
            &(VkImageViewCreateInfo){
                .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                .image = exec->images[use->image],
                .viewType = view_type(image, use),
                .format = image->image->format,
                .subresourceRange = use->range,
            });
    rg_exec_name(exec, VK_OBJECT_TYPE_IMAGE_VIEW, (uint64_t)*view, image->image->name);
fail:
    return result;
}

static bool same_sampler(const struct rg_sampler *a, const struct rg_sampler *b)
{
    return a->linear == b->linear && a->mips == b->mips && a->repeat_u == b->repeat_u &&
           a->repeat_v == b->repeat_v && !(a->anisotropy < b->anisotropy) &&
           !(a->anisotropy > b->anisotropy);
}

static VkSamplerCreateInfo sampler_info(const struct rg_exec *exec, const struct rg_sampler *key)
{
    float anisotropy = key->anisotropy < exec->params.max_anisotropy ? key->anisotropy
                                                                     : exec->params.max_anisotropy;
    VkFilter filter = key->linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    return (VkSamplerCreateInfo){
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter,
        .minFilter = filter,
        .mipmapMode = key->linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
        .addressModeU =
            key->repeat_u ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
        .addressModeV =
            key->repeat_v ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
        .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
        .anisotropyEnable = anisotropy >= 1.0f,
        .maxAnisotropy = anisotropy,
        .maxLod = key->mips ? VK_LOD_CLAMP_NONE : 0.0f,
    };
}

/* Uses with equal rg_sampler share one VkSampler. */
static VkResult find_sampler(struct rg_exec *exec, const struct rg_use *use, VkSampler *sampler)
{
    static const struct rg_sampler nearest = { 0 };
    const struct rg_sampler *key = use->sampler ? use->sampler : &nearest;
    VkResult result = VK_SUCCESS;
    uint32_t i = 0;
    while (i < exec->sampler_count && !same_sampler(&exec->samplers[i].key, key))
        i++;
    if (i == exec->sampler_count) {
        const VkSamplerCreateInfo info = sampler_info(exec, key);
        RG_MAKE(exec, use->image->name, CreateSampler, &exec->samplers[i].sampler, &info);
        exec->samplers[i].key = *key;
        exec->sampler_count++;
    }
    *sampler = exec->samplers[i].sampler;
fail:
    return result;
}

static VkDescriptorSetLayoutBinding layout_binding(const struct rg_pass *pass,
                                                   const struct rg_use *use, VkDescriptorType type)
{
    return (VkDescriptorSetLayoutBinding){ use->binding, type, 1, use_stages(pass, use), NULL };
}

static VkResult make_set_layout(struct rg_exec *exec, const struct rg_plan_pass *plan,
                                VkDescriptorSetLayout *layout)
{
    VkResult result = VK_ERROR_OUT_OF_HOST_MEMORY;
    uint32_t count = 0;
    VkDescriptorSetLayoutBinding *bindings =
        calloc((size_t)plan->use_count + plan->fallback_count + 1, sizeof(*bindings));
    if (!bindings)
        return rg_exec_check(exec, result, "calloc", plan->pass->name);
    for (uint32_t i = 0; i < plan->use_count; i++) {
        const struct rg_plan_use *use = &exec->plan->uses[plan->first_use + i];
        if (has_descriptor(use))
            bindings[count++] = layout_binding(plan->pass, use->use, descriptor_type(use));
    }
    for (uint32_t i = 0; i < plan->fallback_count; i++)
        bindings[count++] =
            layout_binding(plan->pass, exec->plan->fallbacks[plan->first_fallback + i],
                           VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    RG_MAKE(exec, plan->pass->name, CreateDescriptorSetLayout, layout,
            &(VkDescriptorSetLayoutCreateInfo){
                .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                .bindingCount = count,
                .pBindings = bindings,
            });
fail:
    free(bindings);
    return result;
}

static VkResult make_pool(struct rg_exec *exec)
{
    static const VkDescriptorType types[] = {
        VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
        VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
        VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
        VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
    };

    enum {
        TYPE_COUNT = sizeof(types) / sizeof(types[0])
    };

    VkDescriptorPoolSize sizes[TYPE_COUNT];
    uint32_t set_count = exec->slot_count * exec->image_set_count; /* of a pass */
    VkResult result;
    for (uint32_t t = 0; t < TYPE_COUNT; t++) {
        sizes[t] = (VkDescriptorPoolSize){ types[t], set_count }; /* never 0 */
        for (uint32_t i = 0; i < exec->plan->use_count; i++) {
            if (descriptor_type(&exec->plan->uses[i]) == types[t])
                sizes[t].descriptorCount += set_count;
        }
    }
    sizes[0].descriptorCount += exec->plan->fallback_count * set_count; /* they are sampled */
    RG_MAKE(exec, NULL, CreateDescriptorPool, &exec->descriptor_pool,
            &(VkDescriptorPoolCreateInfo){
                .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                .maxSets = set_count * exec->plan->pass_count + 1,
                .poolSizeCount = TYPE_COUNT,
                .pPoolSizes = sizes,
            });
fail:
    return result;
}

static void write_descriptor(const struct rg_exec *exec, VkDescriptorSet set,
                             const struct rg_use *use, VkDescriptorType type,
                             const VkDescriptorImageInfo *image,
                             const VkDescriptorBufferInfo *buffer)
{
    const VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = set,
        .dstBinding = use->binding,
        .descriptorCount = 1,
        .descriptorType = type,
        .pImageInfo = image,
        .pBufferInfo = buffer,
    };
    exec->vk.UpdateDescriptorSets(exec->device, 1, &write, 0, NULL);
}

static VkResult write_use(struct rg_exec *exec, uint32_t index, uint32_t slot, VkDescriptorSet set)
{
    const struct rg_plan_use *use = &exec->plan->uses[index];
    VkDescriptorBufferInfo buffer = { .range = VK_WHOLE_SIZE };
    VkDescriptorImageInfo image = {
        .imageView = *rg_exec_use_view(exec, index),
        .imageLayout = use->layout,
    };
    VkResult result = VK_SUCCESS;
    if (!has_descriptor(use))
        return VK_SUCCESS;
    if (use->buffer != RG_NONE)
        buffer.buffer = rg_exec_buffer(exec, use->buffer, slot);
    else if (use->use->access == RG_SAMPLED)
        result = find_sampler(exec, use->use, &image.sampler);
    if (result == VK_SUCCESS)
        write_descriptor(exec, set, use->use, descriptor_type(use), &image, &buffer);
    return result;
}

static VkResult write_fallback(struct rg_exec *exec, uint32_t index, VkDescriptorSet set)
{
    const struct rg_use *use = exec->plan->fallbacks[index];
    VkDescriptorImageInfo image = {
        .imageView = exec->fallbacks[index].view,
        .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
    };
    VkResult result = find_sampler(exec, use, &image.sampler);
    if (result == VK_SUCCESS)
        write_descriptor(exec, set, use, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, &image, NULL);
    return result;
}

static VkResult make_sets(struct rg_exec *exec, const struct rg_plan_pass *plan,
                          struct exec_pass *pass)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t slot = 0; slot < exec->slot_count; slot++) {
        VkDescriptorSet *set = rg_exec_set(exec, pass, slot);
        RG_CALL(exec, plan->pass->name, AllocateDescriptorSets, exec->device,
                &(VkDescriptorSetAllocateInfo){
                    .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                    .descriptorPool = exec->descriptor_pool,
                    .descriptorSetCount = 1,
                    .pSetLayouts = &pass->set_layout,
                },
                set);
        for (uint32_t i = 0; i < plan->use_count; i++)
            RG_PASS(write_use(exec, plan->first_use + i, slot, *set));
        for (uint32_t i = 0; i < plan->fallback_count; i++)
            RG_PASS(write_fallback(exec, plan->first_fallback + i, *set));
    }
fail:
    return result;
}

static VkResult make_set_layouts(struct rg_exec *exec)
{
    const struct rg_plan *plan = exec->plan;
    VkResult result = VK_SUCCESS;
    for (uint32_t p = 0; p < plan->pass_count && result == VK_SUCCESS; p++) {
        struct exec_pass *pass = &exec->passes[p];
        pass->owner = p == 0 || plan->passes[p - 1].pass != plan->passes[p].pass;
        if (pass->owner)
            result = make_set_layout(exec, &plan->passes[p], &pass->set_layout);
        else
            pass->set_layout = exec->passes[p - 1].set_layout;
        pass->sets =
            calloc((size_t)exec->slot_count * exec->image_set_count, sizeof(VkDescriptorSet));
        if (!pass->sets)
            result = rg_exec_check(exec, VK_ERROR_OUT_OF_HOST_MEMORY, "calloc",
                                   plan->passes[p].pass->name);
    }
    return result;
}

VkResult rg_exec_make_descriptors(struct rg_exec *exec)
{
    const struct rg_plan *plan = exec->plan;
    VkResult result = make_pool(exec);
    if (result == VK_SUCCESS)
        result = make_set_layouts(exec);
    for (uint32_t c = 0; c < exec->image_set_count; c++) {
        rg_exec_select_image_set(exec, c);
        for (uint32_t i = 0; i < plan->use_count && result == VK_SUCCESS; i++)
            result = make_use_view(exec, i);
        for (uint32_t p = 0; p < plan->pass_count && result == VK_SUCCESS; p++)
            result = make_sets(exec, &plan->passes[p], &exec->passes[p]);
    }
    return result;
}

void rg_exec_free_descriptors(struct rg_exec *exec)
{
    for (uint32_t p = 0; exec->passes && p < exec->plan->pass_count; p++) {
        if (exec->passes[p].owner)
            exec->vk.DestroyDescriptorSetLayout(exec->device, exec->passes[p].set_layout, NULL);
        free(exec->passes[p].sets);
    }
    for (uint32_t i = 0; exec->use_views && i < exec->plan->use_count * exec->image_set_count; i++)
        exec->vk.DestroyImageView(exec->device, exec->use_views[i], NULL);
    for (uint32_t i = 0; i < exec->sampler_count; i++)
        exec->vk.DestroySampler(exec->device, exec->samplers[i].sampler, NULL);
    exec->vk.DestroyDescriptorPool(exec->device, exec->descriptor_pool, NULL);
}
