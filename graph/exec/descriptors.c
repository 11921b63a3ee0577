/* descriptors.c: views, samplers and descriptor set 0 of the uses of each row. */
#include "graph/exec/exec.h"

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
        RG_MAKE(exec, use->image->name, SAMPLER, CreateSampler, &exec->samplers[i].sampler, &info);
        exec->samplers[i].key = *key;
        exec->sampler_count++;
    }
    *sampler = exec->samplers[i].sampler;
fail:
    return result;
}

/* What a use of a pass binds, and where. */
struct descriptor {
    const struct rg_use *use;
    VkDescriptorType type; /* VK_DESCRIPTOR_TYPE_MAX_ENUM: nothing */
    uint32_t buffer;       /* index into the plan's, or RG_NONE */
    VkDescriptorImageInfo image;
};

/* Returns how many descriptors a pass has: uses, then uses that are bound to their fallback. */
static uint32_t descriptor_count(const struct rg_plan_pass *pass)
{
    return pass->use_count + pass->fallback_count;
}

static struct descriptor descriptor_of(const struct rg_exec *exec, const struct rg_plan_pass *pass,
                                       uint32_t index)
{
    if (index >= pass->use_count) {
        uint32_t fallback = pass->first_fallback + index - pass->use_count;
        return (struct descriptor){
            .use = exec->plan->fallbacks[fallback],
            .type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            .buffer = RG_NONE,
            .image.imageView = exec->fallbacks[fallback].view,
            .image.imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        };
    }
    const struct rg_plan_use *use = &exec->plan->uses[pass->first_use + index];
    const struct rg_access_info *info = rg_access_info(use->use->access);
    return (struct descriptor){
        .use = use->use,
        .type = use->image != RG_NONE ? info->image_descriptor : info->buffer_descriptor,
        .buffer = use->buffer,
        .image.imageLayout = use->layout,
    };
}

static VkResult make_set_layout(struct rg_exec *exec, const struct rg_plan_pass *plan,
                                VkDescriptorSetLayout *layout)
{
    VkResult result;
    uint32_t count = 0;
    VkDescriptorSetLayoutBinding *bindings;
    if (!RG_MAKE_ARRAY(exec, bindings, descriptor_count(plan)))
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    for (uint32_t i = 0; i < descriptor_count(plan); i++) {
        const struct descriptor d = descriptor_of(exec, plan, i);
        if (d.type != VK_DESCRIPTOR_TYPE_MAX_ENUM)
            bindings[count++] = (VkDescriptorSetLayoutBinding){
                .binding = d.use->binding,
                .descriptorType = d.type,
                .descriptorCount = 1,
                .stageFlags = use_stages(plan->pass, d.use),
            };
    }
    RG_MAKE(exec, plan->pass->name, DESCRIPTOR_SET_LAYOUT, CreateDescriptorSetLayout, layout,
            &(VkDescriptorSetLayoutCreateInfo){
                .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                .bindingCount = count,
                .pBindings = bindings,
            });
fail:
    return result;
}

/* Has room for each descriptor to be of any type. */
static VkResult make_pool(struct rg_exec *exec)
{
    const struct rg_plan *plan = exec->plan;
    uint32_t set_count = exec->slot_count * exec->image_set_count; /* of a pass */
    uint32_t count = (plan->use_count + plan->fallback_count) * set_count + 1;
    const VkDescriptorPoolSize sizes[] = {
        { VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count },
        { VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, count },
        { VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count },
        { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count },
    };
    VkResult result;
    RG_MAKE(exec, NULL, DESCRIPTOR_POOL, CreateDescriptorPool, &exec->descriptor_pool,
            &(VkDescriptorPoolCreateInfo){
                .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                .maxSets = set_count * plan->pass_count + 1,
                .poolSizeCount = sizeof(sizes) / sizeof(sizes[0]),
                .pPoolSizes = sizes,
            });
fail:
    return result;
}

/* Writes a descriptor into the sets of all slots. */
static void write_descriptor(const struct rg_exec *exec, const struct descriptor *d,
                             const VkDescriptorSet *sets)
{
    for (uint32_t slot = 0; slot < exec->slot_count; slot++) {
        VkDescriptorBufferInfo buffer = { .range = VK_WHOLE_SIZE };
        if (d->buffer != RG_NONE)
            buffer.buffer = rg_exec_buffer(exec, d->buffer, slot)->buffer;
        const VkWriteDescriptorSet write = {
            .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
            .dstSet = sets[slot],
            .dstBinding = d->use->binding,
            .descriptorCount = 1,
            .descriptorType = d->type,
            .pImageInfo = &d->image,
            .pBufferInfo = &buffer,
        };
        exec->vk.UpdateDescriptorSets(exec->device, 1, &write, 0, NULL);
    }
}

static VkResult make_descriptor(struct rg_exec *exec, const struct exec_image_set *set,
                                uint32_t pass, uint32_t index)
{
    const struct rg_plan_pass *plan = &exec->plan->passes[pass];
    struct descriptor d = descriptor_of(exec, plan, index);
    VkResult result = VK_SUCCESS;
    if (d.type == VK_DESCRIPTOR_TYPE_MAX_ENUM)
        return result;
    if (d.use->access == RG_SAMPLED)
        RG_PASS(find_sampler(exec, d.use, &d.image.sampler));
    if (d.buffer == RG_NONE && !d.image.imageView) {
        const struct rg_plan_use *use = &exec->plan->uses[plan->first_use + index];
        const struct rg_plan_image *image = &exec->plan->images[use->image];
        RG_PASS(rg_exec_make_view(exec, image, set->images[use->image], view_type(image, use),
                                  &use->range, &d.image.imageView));
    }
    write_descriptor(exec, &d, &set->descriptors[(size_t)pass * exec->slot_count]);
fail:
    return result;
}

static VkResult make_sets(struct rg_exec *exec, const struct exec_image_set *set, uint32_t pass)
{
    const struct rg_plan_pass *plan = &exec->plan->passes[pass];
    VkResult result = VK_SUCCESS;
    for (uint32_t slot = 0; slot < exec->slot_count; slot++)
        RG_CALL(exec, plan->pass->name, AllocateDescriptorSets, exec->device,
                &(VkDescriptorSetAllocateInfo){
                    .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                    .descriptorPool = exec->descriptor_pool,
                    .descriptorSetCount = 1,
                    .pSetLayouts = &exec->passes[pass].set_layout,
                },
                &set->descriptors[(size_t)pass * exec->slot_count + slot]);
    for (uint32_t i = 0; i < descriptor_count(plan); i++)
        RG_PASS(make_descriptor(exec, set, pass, i));
fail:
    return result;
}

VkResult rg_exec_make_descriptors(struct rg_exec *exec)
{
    const struct rg_plan_pass *plan = exec->plan->passes;
    VkResult result = make_pool(exec);
    for (uint32_t p = 0; p < exec->plan->pass_count && result == VK_SUCCESS; p++) {
        if (p > 0 && plan[p - 1].pass == plan[p].pass)
            exec->passes[p].set_layout = exec->passes[p - 1].set_layout;
        else
            result = make_set_layout(exec, &plan[p], &exec->passes[p].set_layout);
        for (uint32_t i = 0; i < exec->image_set_count && result == VK_SUCCESS; i++)
            result = make_sets(exec, &exec->image_sets[i], p);
    }
    return result;
}
