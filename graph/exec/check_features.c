/* check_features.c: reports device features that a plan needs and the device lacks. */
#include "graph/exec/executor_internal.h"

struct features {
    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan11Features v11;
    VkPhysicalDeviceVulkan12Features v12;
    VkPhysicalDeviceVulkan13Features v13;
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures;
    VkPhysicalDeviceRayQueryFeaturesKHR queries;
};

/* Queries the supported features, limited to those in rg_exec_params.features. */
static void find_features(const struct rg_exec *exec, struct features *f)
{
    const VkPhysicalDeviceFeatures2 *enabled = exec->params.features;
    *f = (struct features){
        .core = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &f->v11 },
        .v11 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES, .pNext = &f->v12 },
        .v12 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &f->v13 },
        .v13 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                 .pNext = &f->structures },
        .structures = { .sType =
                            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR,
                        .pNext = &f->queries },
        .queries = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR },
    };
    exec->vk.GetPhysicalDeviceFeatures2(exec->params.physical, &f->core);
    if (enabled)
        f->core.features = enabled->features;
    for (const VkBaseInStructure *s = enabled ? enabled->pNext : NULL; s; s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES)
            f->v11 = *(const VkPhysicalDeviceVulkan11Features *)s;
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES)
            f->v12 = *(const VkPhysicalDeviceVulkan12Features *)s;
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES)
            f->v13 = *(const VkPhysicalDeviceVulkan13Features *)s;
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR)
            f->structures = *(const VkPhysicalDeviceAccelerationStructureFeaturesKHR *)s;
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR)
            f->queries = *(const VkPhysicalDeviceRayQueryFeaturesKHR *)s;
    }
}

/* Returns true if targets of one pass have different blend states. */
static bool blends_differ(const struct rg_plan *plan)
{
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        for (uint32_t i = 1; i < plan->passes[p].color_count; i++) {
            const struct rg_target *color = plan->passes[p].pass->color;
            if (color[i].blend != color[0].blend || color[i].blend_state != color[0].blend_state)
                return true;
        }
    }
    return false;
}

static bool has_structures(const struct rg_plan *plan)
{
    for (uint32_t i = 0; i < plan->buffer_count; i++) {
        if (plan->buffers[i].usage & VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR)
            return true;
    }
    return false;
}

/* Returns true if the executor creates a sampler with a reduction mode for some use. */
static bool reduces(const struct rg_exec *exec)
{
    const struct rg_exec_params *p = &exec->params;
    for (uint32_t i = 0; i < exec->plan->use_count; i++) {
        const struct rg_sampler *s = exec->plan->uses[i].use->sampler;
        bool is_own = false;
        for (size_t k = 0; k < p->sampler_count; k++)
            is_own = is_own || p->samplers[k].sampler == s;
        if (s && s->reduction && !is_own)
            return true;
    }
    return false;
}

/* Returns true if a raster pass writes storage in a shader stage, by default the fragment stage. */
static bool writes_in(const struct rg_plan *plan, VkShaderStageFlagBits stage)
{
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        const struct rg_plan_pass *pass = &plan->passes[p];
        for (uint32_t i = 0; i < pass->use_count && pass->pass->kind == RG_RASTER; i++) {
            const struct rg_use *use = plan->uses[pass->first_use + i].use;
            VkShaderStageFlags stages = use->stages ? use->stages : VK_SHADER_STAGE_FRAGMENT_BIT;
            if (rg_access_info(use->access)->writes_content && (stages & stage))
                return true;
        }
    }
    return false;
}

/* ---- features required by shaders ---- */

#define NEEDS(number, field, path) \
    { \
        number, "the feature " #field, offsetof(struct features, path) \
    }
#define CORE(number, field)                 NEEDS(number, field, core.features.field)
#define V11(number, field)                  NEEDS(number, field, v11.field)
#define V12(number, field)                  NEEDS(number, field, v12.field)
#define RAYS(number, field)                 NEEDS(number, field, queries.field)
#define DESCRIPTORS(number, kind, indexing) V12(number, shader##kind##Array##indexing##Indexing)

/* Device features that SPIR-V capabilities require (OpCapability; SPIR-V 1.6, section 3.31). */
static const struct capability {
    uint32_t number;
    const char *name;
    size_t offset; /* of the feature in struct features */
} capabilities[] = {
    V12(9, shaderFloat16),
    CORE(10, shaderFloat64),
    CORE(11, shaderInt64),
    CORE(22, shaderInt16),
    CORE(25, shaderImageGatherExtended),
    CORE(27, shaderStorageImageMultisample),
    CORE(28, shaderUniformBufferArrayDynamicIndexing),
    CORE(29, shaderSampledImageArrayDynamicIndexing),
    CORE(30, shaderStorageBufferArrayDynamicIndexing),
    CORE(31, shaderStorageImageArrayDynamicIndexing),
    CORE(32, shaderClipDistance),
    CORE(33, shaderCullDistance),
    CORE(35, sampleRateShading),
    V12(39, shaderInt8),
    CORE(55, shaderStorageImageReadWithoutFormat),
    CORE(56, shaderStorageImageWriteWithoutFormat),
    V12(69, shaderOutputLayer),
    RAYS(4472, rayQuery),
    V11(4427, shaderDrawParameters),
    V11(4433, storageBuffer16BitAccess),
    V11(4439, multiview),
    V12(5302, runtimeDescriptorArray),
    DESCRIPTORS(5304, UniformTexelBuffer, Dynamic),
    DESCRIPTORS(5305, StorageTexelBuffer, Dynamic),
    DESCRIPTORS(5306, UniformBuffer, NonUniform),
    DESCRIPTORS(5307, SampledImage, NonUniform),
    DESCRIPTORS(5308, StorageBuffer, NonUniform),
    DESCRIPTORS(5309, StorageImage, NonUniform),
    DESCRIPTORS(5311, UniformTexelBuffer, NonUniform),
    DESCRIPTORS(5312, StorageTexelBuffer, NonUniform),
    V12(5347, bufferDeviceAddress),
};

/* Returns true if a shader (known to be valid SPIR-V) declares a capability. */
static bool declares(const struct rg_exec *exec, const struct rg_shader *shader, uint32_t number)
{
    enum {
        HEADER_WORDS = 5,
        OP_CAPABILITY = 17, /* capabilities come first in a module */
    };

    const struct rg_shader *code = shader ? rg_exec_code(exec, shader) : NULL;
    for (size_t i = HEADER_WORDS; code && code->words && i + 1 < code->word_count; i += 2) {
        if (code->words[i] != (2u << 16 | OP_CAPABILITY))
            return false;
        if (code->words[i + 1] == number)
            return true;
    }
    return false;
}

static VkResult check_capabilities(const struct rg_exec *exec, const struct features *f)
{
    const struct rg_plan *plan = exec->plan;
    VkResult result = VK_SUCCESS;
    for (size_t i = 0; i < sizeof(capabilities) / sizeof(capabilities[0]); i++) {
        const struct capability *c = &capabilities[i];
        bool needed = false;
        if (*(const VkBool32 *)((const char *)f + c->offset))
            continue;
        for (uint32_t p = 0; p < plan->pass_count && !needed; p++) {
            const struct rg_pass *row = plan->passes[p].pass;
            needed = declares(exec, row->vert, c->number) || declares(exec, row->frag, c->number) ||
                     declares(exec, row->comp, c->number);
        }
        if (needed)
            result = rg_exec_check(exec, VK_ERROR_FEATURE_NOT_PRESENT, c->name, "the device");
    }
    return result;
}

VkResult rg_exec_check_features(struct rg_exec *exec)
{
    const struct rg_exec_params *p = &exec->params;
    struct features f;
    find_features(exec, &f);
    const VkPhysicalDeviceFeatures *core = &f.core.features;
    VkResult result = check_capabilities(exec, &f);
    bool clamps_bias = false, has_views = false;
    for (uint32_t i = 0; i < exec->plan->pass_count; i++) {
        clamps_bias = clamps_bias || exec->plan->passes[i].pass->depth_bias.clamp != 0.0f;
        has_views = has_views || exec->plan->passes[i].pass->multiview;
    }
    exec->has_indirect_count = f.v12.drawIndirectCount;
    exec->has_structures = has_structures(exec->plan);

    const struct {
        const char *name;
        bool needed, there;
    } features[] = {
        { "the feature dynamicRendering", !exec->extensions.render_passes, f.v13.dynamicRendering },
        { "the feature synchronization2", true, f.v13.synchronization2 },
        { "the feature maintenance4", true, f.v13.maintenance4 },
        { "the feature scalarBlockLayout", true, f.v12.scalarBlockLayout },
        { "the feature separateDepthStencilLayouts", true, f.v12.separateDepthStencilLayouts },
        { "the feature independentBlend", blends_differ(exec->plan), core->independentBlend },
        { "the feature accelerationStructure", exec->has_structures,
          f.structures.accelerationStructure },
        { "the feature depthBiasClamp", clamps_bias, core->depthBiasClamp },
        { "the feature multiview", has_views, f.v11.multiview },
        { "the feature fragmentStoresAndAtomics",
          writes_in(exec->plan, VK_SHADER_STAGE_FRAGMENT_BIT), core->fragmentStoresAndAtomics },
        { "the feature vertexPipelineStoresAndAtomics",
          writes_in(exec->plan, VK_SHADER_STAGE_VERTEX_BIT), core->vertexPipelineStoresAndAtomics },
        { "the feature timelineSemaphore", exec->plan->submission_count, f.v12.timelineSemaphore },
        { "the feature samplerFilterMinmax", reduces(exec), f.v12.samplerFilterMinmax },
        { "the feature samplerAnisotropy", p->max_anisotropy >= 1.0f, core->samplerAnisotropy },
        { "the feature pipelineStatisticsQuery", p->statistics, core->pipelineStatisticsQuery },
        { "the feature occlusionQueryPrecise", p->statistics, core->occlusionQueryPrecise },
    };

    for (size_t i = 0; i < sizeof(features) / sizeof(features[0]); i++) {
        if (features[i].needed && !features[i].there)
            result =
                rg_exec_check(exec, VK_ERROR_FEATURE_NOT_PRESENT, features[i].name, "the device");
    }
    return result;
}
