/* descriptors.c: creates views, samplers and descriptor set 0 for the uses of each pass. */
#include "graph/exec/executor_internal.h"

enum {
    /* passes whose sets come from one descriptor pool, which exists as long as one of them */
    PASSES_PER_POOL = 16,
};

static VkImageViewType view_type(const struct rg_plan_image *image, uint32_t layers, bool storage)
{
    if (image->image->depth)
        return VK_IMAGE_VIEW_TYPE_3D;
    if (image->image->cube && !storage && layers == 6)
        return VK_IMAGE_VIEW_TYPE_CUBE;
    if (image->layers > 1 || image->image->array)
        return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    return VK_IMAGE_VIEW_TYPE_2D;
}

static VkSamplerAddressMode address_mode(const struct rg_sampler *s, bool repeats)
{
    if (repeats)
        return s->mirror ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT : VK_SAMPLER_ADDRESS_MODE_REPEAT;
    return s->border ? VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER
                     : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
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
        .addressModeU = address_mode(key, key->repeat_u),
        .addressModeV = address_mode(key, key->repeat_v),
        .addressModeW = address_mode(key, key->repeat_w),
        .mipLodBias = key->mips ? key->lod_bias : 0.0f,
        .anisotropyEnable = anisotropy >= 1.0f,
        .maxAnisotropy = anisotropy,
        .compareEnable = key->compare != 0,
        .compareOp = key->compare,
        .minLod = key->mips ? key->min_lod : 0.0f,
        .maxLod = !key->mips            ? 0.0f
                  : key->max_lod > 0.0f ? key->max_lod
                                        : VK_LOD_CLAMP_NONE,
        .borderColor = key->border_color,
    };
}

/* Returns the application's sampler for a use if there is one, else a sampler that equal rg_sampler
 * structs share. */
static VkResult find_sampler(struct rg_exec *exec, const struct rg_use *use, VkSampler *sampler)
{
    static const struct rg_sampler nearest = { 0 };
    const struct rg_sampler *s = use->sampler ? use->sampler : &nearest;
    const VkSamplerReductionModeCreateInfo reduction = {
        .sType = VK_STRUCTURE_TYPE_SAMPLER_REDUCTION_MODE_CREATE_INFO,
        .reductionMode = s->reduction,
    };
    VkSamplerCreateInfo info = sampler_info(exec, s);
    VkResult result;
    for (size_t i = 0; i < exec->params.sampler_count; i++) {
        if (exec->params.samplers[i].sampler != s)
            continue;
        *sampler = exec->params.samplers[i].handle;
        return VK_SUCCESS;
    }
    info.pNext = s->reduction ? &reduction : NULL;
    /* from `flags` on, all members have 4 bytes */
    rg_exec_key(exec, &info.flags, sizeof(info) - offsetof(VkSamplerCreateInfo, flags));
    RG_KEY(exec, s->reduction);
    RG_MAKE(exec, use->image->name, SAMPLER, CreateSampler, sampler, &info);
fail:
    return result;
}

/* Returns the number of uses of a pass, including those bound to their fallback. */
static uint32_t descriptor_count(const struct rg_plan_pass *pass)
{
    return pass->use_count + pass->fallback_count;
}

static struct exec_descriptor descriptor_of(const struct rg_exec *exec,
                                            const struct rg_plan_pass *pass, uint32_t index)
{
    if (index >= pass->use_count) {
        uint32_t fallback = pass->first_fallback + index - pass->use_count;
        return (struct exec_descriptor){
            .use = exec->plan->fallbacks[fallback],
            .type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
            .buffer = RG_NONE,
            .image.imageView = exec->fallbacks[fallback].view,
            .image.imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        };
    }
    const struct rg_plan_use *use = &exec->plan->uses[pass->first_use + index];
    return (struct exec_descriptor){
        .use = use->use,
        .type = rg_use_descriptor(use->use),
        .buffer = use->buffer,
        .image.imageLayout = use->layout,
    };
}

/* Returns the index of a binding number in a list, or `count` if the list does not contain it. */
static uint32_t find_binding(const VkDescriptorSetLayoutBinding *bindings, uint32_t count,
                             uint32_t binding)
{
    uint32_t at = 0;
    while (at < count && bindings[at].binding != binding)
        at++;
    return at;
}

static VkResult make_set_layout(struct rg_exec *exec, const struct rg_plan_pass *plan,
                                VkDescriptorSetLayout *layout)
{
    VkResult result;
    uint32_t count = 0;
    VkDescriptorSetLayoutBinding *bindings = exec->bindings;
    for (uint32_t i = 0; i < descriptor_count(plan); i++) {
        const struct exec_descriptor d = descriptor_of(exec, plan, i);
        if (d.type == VK_DESCRIPTOR_TYPE_MAX_ENUM)
            continue;
        const uint32_t at = find_binding(bindings, count, d.use->binding);
        if (at == count)
            bindings[count++] = (VkDescriptorSetLayoutBinding){
                .binding = d.use->binding,
                .descriptorType = d.type,
                .stageFlags = d.use->stages ? d.use->stages : rg_exec_stages(plan->pass),
            };
        bindings[at].descriptorCount++;
    }
    for (uint32_t i = 0; i < count; i++) {
        RG_KEY(exec, (uint64_t)bindings[i].binding << 32 | bindings[i].stageFlags);
        RG_KEY(exec,
               (uint64_t)bindings[i].descriptorCount << 32 | (uint32_t)bindings[i].descriptorType);
    }
    RG_KEY(exec, count);
    RG_MAKE(exec, plan->pass->name, DESCRIPTOR_SET_LAYOUT, CreateDescriptorSetLayout, layout,
            &(VkDescriptorSetLayoutCreateInfo){
                .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                .bindingCount = count,
                .pBindings = bindings,
            });
fail:
    return result;
}

/* Finds or creates the view of a texel buffer for a frame slot; views of imports are not cached. */
static VkResult find_texels(struct rg_exec *exec, const struct exec_descriptor *d, uint32_t slot,
                            VkBufferView *view)
{
    const struct rg_buffer *declared = d->use->buffer;
    VkBuffer buffer = rg_exec_buffer(exec, d->buffer, slot)->buffer;
    VkResult result;
    if (!exec->plan->buffers[d->buffer].imported) {
        RG_KEY(exec, buffer);
        RG_KEY(exec, declared->format);
    }
    RG_MAKE(exec, declared->name, BUFFER_VIEW, CreateBufferView, view,
            &(VkBufferViewCreateInfo){
                .sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                .buffer = buffer,
                .format = declared->format,
                .range = VK_WHOLE_SIZE,
            });
fail:
    return result;
}

static bool is_texels(const struct exec_descriptor *d)
{
    return d->type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER ||
           d->type == VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
}

/* Fills exec->descriptors for a pass. */
static VkResult find_descriptors(struct rg_exec *exec, const struct exec_image_set *set,
                                 const struct rg_plan_pass *plan)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < descriptor_count(plan); i++) {
        struct exec_descriptor *d = &exec->descriptors[i];
        *d = descriptor_of(exec, plan, i);
        if (d->type == VK_DESCRIPTOR_TYPE_MAX_ENUM)
            continue;
        if (d->type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)
            RG_TRY(find_sampler(exec, d->use, &d->image.sampler));
        if (d->buffer == RG_NONE && !d->image.imageView) {
            const struct rg_plan_use *use = &exec->plan->uses[plan->first_use + i];
            const struct rg_plan_image *image = &exec->plan->images[use->image];
            const struct exec_view view = {
                .type = view_type(image, use->range.layerCount, use->use->access != RG_SAMPLED),
                .usage = rg_access_info(use->use->access)->image_usage,
                .format = use->use->view_format,
                .range = use->range,
            };
            RG_TRY(rg_exec_make_view(exec, image, set->images[use->image], &view,
                                     &d->image.imageView));
        }
    }
fail:
    return result;
}

/* Stores the key of the descriptor sets of a pass. If a buffer is imported, the key is empty,
 * because the program may reuse the buffer's handle for another buffer. A texel buffer's view
 * depends on the buffer and on the format of its declaration. */
static void add_descriptors(struct rg_exec *exec, const struct rg_plan_pass *plan,
                            VkDescriptorSetLayout layout)
{
    RG_KEY(exec, RG_ARRAY_SETS);
    RG_KEY(exec, layout);
    for (uint32_t i = 0; i < descriptor_count(plan); i++) {
        const struct exec_descriptor *d = &exec->descriptors[i];
        if (d->type == VK_DESCRIPTOR_TYPE_MAX_ENUM)
            continue;
        RG_KEY(exec, d->image.imageView);
        RG_KEY(exec, d->image.sampler);
        RG_KEY(exec, (uint64_t)d->use->element << 32 | d->image.imageLayout);
        RG_KEY(exec, d->buffer == RG_NONE ? VK_FORMAT_UNDEFINED : d->use->buffer->format);
        for (uint32_t slot = 0; slot < exec->slot_count && d->buffer != RG_NONE; slot++)
            RG_KEY(exec, rg_exec_buffer(exec, d->buffer, slot)->buffer);
        if (d->buffer != RG_NONE && exec->plan->buffers[d->buffer].imported) {
            exec->key_size = 0;
            return;
        }
    }
}

/* Creates the pool for the sets of up to PASSES_PER_POOL passes. If the plan has no acceleration
 * structures, the pool has none (the last entry). */
static VkResult open_pool(struct rg_exec *exec, uint32_t first)
{
    VkDescriptorPoolSize sizes[] = {
        { VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1 },
        { VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1 },
        { VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1 },
        { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1 },
        { VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1 },
        { VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, 1 },
        { VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1 },
    };
    const uint32_t size_count = (uint32_t)(sizeof(sizes) / sizeof(sizes[0]));
    const uint32_t rest = exec->plan->pass_count - first;
    const uint32_t pass_count = rest < PASSES_PER_POOL ? rest : PASSES_PER_POOL;
    const uint32_t set_count = exec->slot_count * exec->image_set_count; /* of a pass, at most */
    VkResult result;
    for (uint32_t p = first; p < first + pass_count; p++) {
        const struct rg_plan_pass *plan = &exec->plan->passes[p];
        for (uint32_t i = 0; i < descriptor_count(plan); i++) {
            const VkDescriptorType type = descriptor_of(exec, plan, i).type;
            for (uint32_t k = 0; k < size_count; k++)
                sizes[k].descriptorCount += sizes[k].type == type ? set_count : 0;
        }
    }
    exec->pool_end = first + pass_count;
    RG_KEY(exec, ++exec->pool_number);
    RG_MAKE(exec, exec->plan->passes[first].pass->name, DESCRIPTOR_POOL, CreateDescriptorPool,
            &exec->pool,
            &(VkDescriptorPoolCreateInfo){
                .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                .maxSets = pass_count * set_count,
                .poolSizeCount = size_count - !exec->has_structures,
                .pPoolSizes = sizes,
            });
fail:
    return result;
}

/* Writes the descriptors of a pass into the set of a frame slot. */
static VkResult write_set(struct rg_exec *exec, const struct rg_plan_pass *plan, uint32_t slot,
                          VkDescriptorSet set)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < descriptor_count(plan); i++) {
        const struct exec_descriptor *d = &exec->descriptors[i];
        VkDescriptorBufferInfo buffer = { .range = VK_WHOLE_SIZE };
        VkBufferView texels = VK_NULL_HANDLE;
        const bool is_structure = d->type == VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
        if (d->type == VK_DESCRIPTOR_TYPE_MAX_ENUM)
            continue;
        const VkWriteDescriptorSetAccelerationStructureKHR structure = {
            .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR,
            .accelerationStructureCount = 1,
            .pAccelerationStructures =
                is_structure ? &rg_exec_buffer(exec, d->buffer, slot)->acceleration : NULL,
        };
        if (d->buffer != RG_NONE)
            buffer.buffer = rg_exec_buffer(exec, d->buffer, slot)->buffer;
        if (is_texels(d))
            RG_TRY(find_texels(exec, d, slot, &texels));
        const VkWriteDescriptorSet write = {
            .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
            .dstSet = set,
            .dstBinding = d->use->binding,
            .dstArrayElement = d->use->element,
            .descriptorCount = 1,
            .descriptorType = d->type,
            .pImageInfo = &d->image,
            .pBufferInfo = &buffer,
            .pTexelBufferView = &texels,
            .pNext = is_structure ? &structure : NULL,
        };
        exec->vk.UpdateDescriptorSets(exec->device, 1, &write, 0, NULL);
    }
fail:
    return result;
}

/* Descriptor sets of a pass, which the next plan may keep with their pool. */
struct exec_sets {
    uint64_t pool; /* number of the pool, its key */
    VkDescriptorSet slots[];
};

/* Returns true if descriptors of a pass differ between frame slots. */
static bool differs_by_slot(const struct rg_exec *exec, const struct rg_plan_pass *plan)
{
    for (uint32_t i = 0; i < descriptor_count(plan); i++) {
        const struct exec_descriptor *d = &exec->descriptors[i];
        if (d->type != VK_DESCRIPTOR_TYPE_MAX_ENUM && d->buffer != RG_NONE &&
            rg_exec_buffer(exec, d->buffer, 0)->host)
            return true;
    }
    return false;
}

/* Keeps the views of a pass's texel buffers, which kept descriptor sets refer to. */
static VkResult keep_texels(struct rg_exec *exec, const struct rg_plan_pass *plan)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t i = 0; i < descriptor_count(plan); i++) {
        const struct exec_descriptor *d = &exec->descriptors[i];
        for (uint32_t slot = 0; slot < exec->slot_count && is_texels(d); slot++) {
            VkBufferView kept;
            RG_TRY(find_texels(exec, d, slot, &kept));
        }
    }
fail:
    return result;
}

/* Creates the descriptor sets of a pass: one per frame slot if they differ, otherwise one. */
static VkResult make_sets(struct rg_exec *exec, const struct exec_image_set *set, uint32_t pass)
{
    const struct rg_plan_pass *plan = &exec->plan->passes[pass];
    const VkDescriptorSetLayout *layout = &exec->passes[pass].set_layout;
    VkDescriptorPool kept;
    VkResult result;
    RG_TRY(find_descriptors(exec, set, plan));
    add_descriptors(exec, plan, *layout);
    struct exec_sets *sets =
        rg_exec_make_array(exec, 1, sizeof(*sets) + exec->slot_count * sizeof(sets->slots[0]));
    if (!sets)
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    set->descriptors[pass] = sets->slots;
    if (exec->found) {
        RG_KEY(exec, sets->pool);
        rg_exec_find(exec, VK_OBJECT_TYPE_DESCRIPTOR_POOL, &kept, sizeof(kept)); /* keeps it */
        return keep_texels(exec, plan);
    }
    if (pass >= exec->pool_end)
        RG_TRY(open_pool(exec, pass));
    sets->pool = exec->pool_number;
    const bool differs = differs_by_slot(exec, plan);
    for (uint32_t slot = 0; slot < exec->slot_count; slot++) {
        sets->slots[slot] = sets->slots[0];
        if (slot > 0 && !differs)
            continue;
        RG_CALL(exec, plan->pass->name, AllocateDescriptorSets, exec->device,
                &(VkDescriptorSetAllocateInfo){
                    .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                    .descriptorPool = exec->pool,
                    .descriptorSetCount = 1,
                    .pSetLayouts = layout,
                },
                &sets->slots[slot]);
        RG_TRY(write_set(exec, plan, slot, sets->slots[slot]));
    }
fail:
    return result;
}

static bool make_room(struct rg_exec *exec)
{
    uint32_t most = 0;
    for (uint32_t p = 0; p < exec->plan->pass_count; p++) {
        uint32_t count = descriptor_count(&exec->plan->passes[p]);
        most = count > most ? count : most;
    }
    return RG_MAKE_ARRAY(exec, exec->bindings, most) &&
           RG_MAKE_ARRAY(exec, exec->descriptors, most);
}

VkResult rg_exec_make_descriptors(struct rg_exec *exec)
{
    VkResult result = make_room(exec) ? VK_SUCCESS : VK_ERROR_OUT_OF_HOST_MEMORY;
    for (uint32_t p = 0; p < exec->plan->pass_count && result == VK_SUCCESS; p++) {
        result = make_set_layout(exec, &exec->plan->passes[p], &exec->passes[p].set_layout);
        for (uint32_t i = 0; i < exec->image_set_count && result == VK_SUCCESS; i++)
            result = make_sets(exec, &exec->image_sets[i], p);
    }
    return result;
}

VkImage rg_exec_image(const struct rg_exec *exec, const struct rg_image *image)
{
    for (uint32_t i = 0; i < exec->plan->image_count; i++) {
        if (exec->plan->images[i].image == image)
            return exec->image_set->images[i];
    }
    return VK_NULL_HANDLE;
}

VkImageView rg_exec_view(struct rg_exec *exec, const struct rg_image *image,
                         const struct rg_range *range)
{
    static const struct rg_range whole = { 0 };
    const struct rg_range *r = range ? range : &whole;
    const struct rg_plan_image *plan = exec->plan->images;
    const struct rg_plan_image *end = plan + exec->plan->image_count;
    VkImageView view = VK_NULL_HANDLE;
    while (plan < end && plan->image != image)
        plan++;
    if (plan == end || plan->imported || r->mip >= plan->mips || r->layer >= plan->layers)
        return VK_NULL_HANDLE;
    const VkImageSubresourceRange all = {
        .aspectMask = r->aspect ? r->aspect : plan->aspects,
        .baseMipLevel = r->mip,
        .levelCount = r->mip_count ? r->mip_count : plan->mips - r->mip,
        .baseArrayLayer = r->layer,
        .layerCount = r->layer_count ? r->layer_count : plan->layers - r->layer,
    };
    const struct exec_view info = {
        .type = view_type(plan, all.layerCount, false),
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
        .range = all,
    };
    VkResult result = rg_exec_make_view(
        exec, plan, exec->image_set->images[plan - exec->plan->images], &info, &view);
    return result == VK_SUCCESS ? view : VK_NULL_HANDLE;
}
