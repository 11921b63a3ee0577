/* features.c: names each feature of the device that a plan needs and does not find. */
#include "graph/exec/exec.h"

struct features {
    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan12Features v12;
    VkPhysicalDeviceVulkan13Features v13;
};

/* Fills what the device supports, and takes away what the program says that it has not enabled. */
static void find_features(const struct rg_exec *exec, struct features *f)
{
    const VkPhysicalDeviceFeatures2 *enabled = exec->params.features;
    *f = (struct features){
        .core = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &f->v12 },
        .v12 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &f->v13 },
        .v13 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES },
    };
    exec->vk.GetPhysicalDeviceFeatures2(exec->params.physical, &f->core);
    if (enabled)
        f->core.features = enabled->features;
    for (const VkBaseInStructure *s = enabled ? enabled->pNext : NULL; s; s = s->pNext) {
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES)
            f->v12 = *(const VkPhysicalDeviceVulkan12Features *)s;
        if (s->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES)
            f->v13 = *(const VkPhysicalDeviceVulkan13Features *)s;
    }
}

/* Whether targets of a row blend differently. */
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

static bool limits_depth_bias(const struct rg_plan *plan)
{
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        if (plan->passes[p].pass->depth_bias.clamp != 0.0f)
            return true;
    }
    return false;
}

/* Whether a raster pass writes storage in a stage; those of fragments are the default. */
static bool writes_in(const struct rg_plan *plan, VkPipelineStageFlags2 stage)
{
    for (uint32_t p = 0; p < plan->pass_count; p++) {
        const struct rg_plan_pass *pass = &plan->passes[p];
        for (uint32_t i = 0; i < pass->use_count && pass->pass->kind == RG_RASTER; i++) {
            const struct rg_use *use = plan->uses[pass->first_use + i].use;
            VkPipelineStageFlags2 stages =
                use->stages ? use->stages : VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
            if (rg_access_info(use->access)->writes_content && (stages & stage))
                return true;
        }
    }
    return false;
}

VkResult rg_exec_check_features(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    const struct rg_exec_params *p = &exec->params;
    struct features f;
    find_features(exec, &f);
    const VkPhysicalDeviceFeatures *core = &f.core.features;

    const struct {
        const char *name;
        bool needed, there;
    } features[] = {
        { "the feature dynamicRendering", !p->render_passes, f.v13.dynamicRendering },
        { "the feature synchronization2", true, f.v13.synchronization2 },
        { "the feature maintenance4", true, f.v13.maintenance4 },
        { "the feature scalarBlockLayout", true, f.v12.scalarBlockLayout },
        { "the feature separateDepthStencilLayouts", true, f.v12.separateDepthStencilLayouts },
        { "the feature independentBlend", blends_differ(exec->plan), core->independentBlend },
        { "the feature depthBiasClamp", limits_depth_bias(exec->plan), core->depthBiasClamp },
        { "the feature fragmentStoresAndAtomics",
          writes_in(exec->plan, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT),
          core->fragmentStoresAndAtomics },
        { "the feature vertexPipelineStoresAndAtomics",
          writes_in(exec->plan, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT),
          core->vertexPipelineStoresAndAtomics },
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
