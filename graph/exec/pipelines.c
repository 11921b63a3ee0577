/* pipelines.c: the pipeline of each row of a plan. */
#include "graph/exec/exec.h"

VkShaderStageFlags rg_exec_stages(const struct rg_pass *pass)
{
    if (pass->kind == RG_COMPUTE)
        return VK_SHADER_STAGE_COMPUTE_BIT;
    return VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
}

static VkResult make_layout(struct rg_exec *exec, const struct rg_pass *row, struct exec_pass *pass)
{
    const VkPushConstantRange push = { rg_exec_stages(row), 0, row->push_size };
    VkResult result;
    RG_MAKE(exec, row->name, PIPELINE_LAYOUT, CreatePipelineLayout, &pass->layout,
            &(VkPipelineLayoutCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                .setLayoutCount = 1,
                .pSetLayouts = &pass->set_layout,
                .pushConstantRangeCount = row->push_size ? 1 : 0,
                .pPushConstantRanges = &push,
            });
fail:
    return result;
}

/* VkPipelineShaderStageCreateInfo needs a module; it is destroyed once the pipeline is made. */
static VkResult make_stage(struct rg_exec *exec, const struct rg_shader *shader,
                           VkShaderStageFlagBits stage, VkPipelineShaderStageCreateInfo *info)
{
    const struct rg_exec_params *params = &exec->params;
    const struct rg_shader *code =
        params->replace_shader ? params->replace_shader(params->user, shader) : shader;
    const VkShaderModuleCreateInfo module = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = code->word_count * sizeof(uint32_t),
        .pCode = code->words,
    };
    *info = (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = stage,
        .pName = "main",
        .pSpecializationInfo = params->constants,
    };
    VkResult result = code->words
                          ? exec->vk.CreateShaderModule(exec->device, &module, NULL, &info->module)
                          : VK_ERROR_INITIALIZATION_FAILED;
    if (result != VK_SUCCESS)
        info->module = VK_NULL_HANDLE; /* Vulkan leaves it undefined */
    return rg_exec_check(exec, result, "vkCreateShaderModule", shader->name);
}

static VkPipelineColorBlendAttachmentState blend_state(enum rg_blend blend)
{
    VkBlendFactor kept =
        blend == RG_BLEND_ADD ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    return (VkPipelineColorBlendAttachmentState){
        .blendEnable = blend != RG_BLEND_NONE,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor = kept,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor = kept,
        .colorWriteMask = 0xf,
    };
}

/* What depends on the targets of a row. */
struct target_state {
    VkPipelineColorBlendAttachmentState blends[RG_COLOR_COUNT];
    VkFormat formats[RG_COLOR_COUNT];
    VkPipelineRenderingCreateInfo rendering;
};

static void fill_target_state(struct target_state *state, const struct rg_exec *exec,
                              const struct rg_plan_pass *plan)
{
    const struct rg_plan_image *images = exec->plan->images;
    state->rendering = (VkPipelineRenderingCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = plan->color_count,
        .pColorAttachmentFormats = state->formats,
    };
    for (uint32_t i = 0; i < plan->color_count; i++) {
        state->blends[i] = blend_state(plan->pass->color[i].blend);
        state->formats[i] = images[plan->color[i].image].image->format;
    }
    if (plan->depth.image == RG_NONE)
        return;
    const struct rg_plan_image *depth = &images[plan->depth.image];
    state->rendering.depthAttachmentFormat = depth->image->format;
    if (depth->aspects & VK_IMAGE_ASPECT_STENCIL_BIT)
        state->rendering.stencilAttachmentFormat = depth->image->format;
}

static VkPipelineVertexInputStateCreateInfo
vertex_input(const struct rg_vertex_layout *layout, const VkVertexInputBindingDescription *binding)
{
    return (VkPipelineVertexInputStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = layout ? 1 : 0,
        .pVertexBindingDescriptions = binding,
        .vertexAttributeDescriptionCount = layout ? layout->attribute_count : 0,
        .pVertexAttributeDescriptions = layout ? layout->attributes : NULL,
    };
}

/* Makes a graphics pipeline from one or two shader stages. */
static VkResult make_graphics(struct rg_exec *exec, const struct rg_plan_pass *plan,
                              struct exec_pass *pass, const VkPipelineShaderStageCreateInfo *stages)
{
    static const VkDynamicState dynamic[] = { VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR };
    const struct rg_pass *row = plan->pass;
    const VkVertexInputBindingDescription binding = {
        .stride = row->vertices ? row->vertices->stride : 0,
    };
    const VkPipelineVertexInputStateCreateInfo vertices = vertex_input(row->vertices, &binding);
    bool has_depth = plan->depth.image != RG_NONE;
    struct target_state targets;
    fill_target_state(&targets, exec, plan);
    VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = pass->render_pass ? NULL : &targets.rendering,
        .stageCount = row->frag ? 2 : 1,
        .pStages = stages,
        .layout = pass->layout,
        .renderPass = pass->render_pass,
    };
    VkResult result;
    info.pVertexInputState = &vertices;
    info.pInputAssemblyState = &(VkPipelineInputAssemblyStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = row->topology ? row->topology : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    };
    info.pViewportState = &(VkPipelineViewportStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1,
    };
    info.pRasterizationState = &(VkPipelineRasterizationStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = row->cull,
        .frontFace = row->front,
        .lineWidth = 1.0f,
    };
    info.pMultisampleState = &(VkPipelineMultisampleStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = rg_exec_samples(exec, plan),
    };
    info.pDepthStencilState = &(VkPipelineDepthStencilStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = has_depth,
        .depthWriteEnable = has_depth && !row->depth_read_only,
        .depthCompareOp = row->depth_compare ? row->depth_compare : VK_COMPARE_OP_LESS_OR_EQUAL,
    };
    info.pColorBlendState = &(VkPipelineColorBlendStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = plan->color_count,
        .pAttachments = targets.blends,
    };
    info.pDynamicState = &(VkPipelineDynamicStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2,
        .pDynamicStates = dynamic,
    };
    RG_MAKE(exec, row->name, PIPELINE, CreateGraphicsPipelines, &pass->pipeline,
            exec->params.pipeline_cache, 1, &info);
fail:
    return result;
}

static VkResult make_pipeline(struct rg_exec *exec, const struct rg_plan_pass *plan,
                              struct exec_pass *pass)
{
    const struct rg_pass *row = plan->pass;
    VkPipelineShaderStageCreateInfo stages[2] = { 0 };
    VkResult result = VK_SUCCESS;
    if (row->kind == RG_TRANSFER)
        return VK_SUCCESS;
    RG_PASS(make_layout(exec, row, pass));
    if (row->kind == RG_COMPUTE) {
        RG_PASS(make_stage(exec, row->comp, VK_SHADER_STAGE_COMPUTE_BIT, &stages[0]));
        RG_MAKE(exec, row->name, PIPELINE, CreateComputePipelines, &pass->pipeline,
                exec->params.pipeline_cache, 1,
                &(VkComputePipelineCreateInfo){
                    .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                    .stage = stages[0],
                    .layout = pass->layout,
                });
    } else {
        RG_PASS(make_stage(exec, row->vert, VK_SHADER_STAGE_VERTEX_BIT, &stages[0]));
        if (row->frag)
            RG_PASS(make_stage(exec, row->frag, VK_SHADER_STAGE_FRAGMENT_BIT, &stages[1]));
        RG_PASS(make_graphics(exec, plan, pass, stages));
    }
fail:
    exec->vk.DestroyShaderModule(exec->device, stages[0].module, NULL);
    exec->vk.DestroyShaderModule(exec->device, stages[1].module, NULL);
    return result;
}

static bool same_target(const struct rg_exec *exec, const struct rg_plan_target *a,
                        const struct rg_plan_target *b)
{
    const struct rg_plan_image *images = exec->plan->images;
    if (a->image == RG_NONE || b->image == RG_NONE)
        return a->image == b->image;
    return images[a->image].image->format == images[b->image].image->format;
}

/* Whether uses bind the same kinds of descriptors, so that their set layouts are compatible. */
static bool bind_alike(const struct rg_use *a, const struct rg_use *b)
{
    if (a == b || !a || !b)
        return a == b;
    while (a->access && a->access == b->access && a->binding == b->binding &&
           a->stages == b->stages && !a->image == !b->image) {
        a++;
        b++;
    }
    return a->access == b->access && !a->access;
}

/* Whether two rows can share a pipeline. */
static bool draw_alike(const struct rg_exec *exec, const struct rg_plan_pass *a,
                       const struct rg_plan_pass *b)
{
    const struct rg_pass *x = a->pass, *y = b->pass;
    bool same = x->vert == y->vert && x->frag == y->frag && bind_alike(x->uses, y->uses) &&
                x->vertices == y->vertices && x->topology == y->topology && x->cull == y->cull &&
                x->front == y->front && x->depth_compare == y->depth_compare &&
                x->depth_read_only == y->depth_read_only && x->push_size == y->push_size &&
                a->color_count == b->color_count && same_target(exec, &a->depth, &b->depth) &&
                rg_exec_samples(exec, a) == rg_exec_samples(exec, b);
    for (uint32_t i = 0; same && i < a->color_count; i++)
        same =
            x->color[i].blend == y->color[i].blend && same_target(exec, &a->color[i], &b->color[i]);
    return same;
}

/* Returns the first pass that a pass can share the pipeline with, since drivers compile equal
 * pipelines again; it may be the pass itself. A pipeline made for a VkRenderPass is only shared by
 * repetitions. */
static uint32_t find_alike(const struct rg_exec *exec, uint32_t p)
{
    const struct rg_plan_pass *passes = exec->plan->passes;
    if (p > 0 && passes[p - 1].pass == passes[p].pass)
        return p - 1;
    for (uint32_t q = 0; q < p && passes[p].pass->kind == RG_RASTER; q++) {
        if (exec->passes[q].first && passes[q].pass->kind == RG_RASTER &&
            !exec->passes[p].render_pass && draw_alike(exec, &passes[p], &passes[q]))
            return q;
    }
    return p;
}

VkResult rg_exec_make_pipelines(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t p = 0; p < exec->plan->pass_count && result == VK_SUCCESS; p++) {
        struct exec_pass *pass = &exec->passes[p];
        uint32_t alike = find_alike(exec, p);
        pass->first = alike == p;
        if (pass->first)
            result = make_pipeline(exec, &exec->plan->passes[p], pass);
        pass->layout = exec->passes[alike].layout;
        pass->pipeline = exec->passes[alike].pipeline;
    }
    return result;
}
