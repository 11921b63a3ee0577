/* pipelines.c: creates the pipeline of each pass of a plan. */
#include "graph/exec/executor_internal.h"

VkShaderStageFlags rg_exec_stages(const struct rg_pass *pass)
{
    if (pass->kind == RG_COMPUTE)
        return VK_SHADER_STAGE_COMPUTE_BIT;
    return VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
}

/* Finds the layout of a descriptor set that the program owns. */
static VkResult find_set_layout(const struct rg_exec *exec, const struct rg_set *set,
                                VkDescriptorSetLayout *layout)
{
    const struct rg_exec_params *params = &exec->params;
    for (size_t i = 0; i < params->set_count; i++) {
        if (params->sets[i].set == set)
            *layout = params->sets[i].layout;
    }
    return *layout ? VK_SUCCESS
                   : rg_exec_check(exec, VK_ERROR_INITIALIZATION_FAILED,
                                   "rg_exec_params.sets: the layout", set->name);
}

static VkResult make_layout(struct rg_exec *exec, const struct rg_pass *row, struct exec_pass *pass)
{
    const VkPushConstantRange push = { rg_exec_stages(row), 0, row->push_size };
    VkDescriptorSetLayout layouts[] = { pass->set_layout, VK_NULL_HANDLE };
    VkResult result;
    if (row->set)
        RG_TRY(find_set_layout(exec, row->set, &layouts[1]));
    rg_exec_key(exec, &push, sizeof(push));
    RG_KEY(exec, layouts[0]);
    RG_KEY(exec, layouts[1]);
    RG_MAKE(exec, row->name, PIPELINE_LAYOUT, CreatePipelineLayout, &pass->layout,
            &(VkPipelineLayoutCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                .setLayoutCount = row->set ? 2 : 1,
                .pSetLayouts = layouts,
                .pushConstantRangeCount = row->push_size ? 1 : 0,
                .pPushConstantRanges = &push,
            });
fail:
    return result;
}

const struct rg_shader *rg_exec_code(const struct rg_exec *exec, const struct rg_shader *shader)
{
    const struct rg_exec_params *params = &exec->params;
    return params->replace_shader ? params->replace_shader(params->user, shader) : shader;
}

/* Fills a shader stage. The caller destroys the shader module once the pipeline is created. */
static VkResult make_stage(struct rg_exec *exec, const struct rg_shader *shader,
                           VkShaderStageFlagBits stage, VkPipelineShaderStageCreateInfo *info)
{
    const struct rg_exec_params *params = &exec->params;
    const struct rg_shader *code = rg_exec_code(exec, shader);
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
        info->module = VK_NULL_HANDLE; /* undefined after a failed Vulkan call */
    return rg_exec_check(exec, result, "vkCreateShaderModule", shader->name);
}

static VkPipelineColorBlendAttachmentState blend_state(const struct rg_target *target)
{
    const enum rg_blend blend = target->blend;
    VkBlendFactor kept =
        blend == RG_BLEND_ADD ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    if (target->blend_state)
        return *target->blend_state;
    return (VkPipelineColorBlendAttachmentState){
        .blendEnable = blend != RG_BLEND_NONE,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor = kept,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor = kept,
        .colorWriteMask = 0xf,
    };
}

/* Pipeline state that depends on the targets of a pass. */
struct target_state {
    VkPipelineColorBlendAttachmentState blends[RG_COLOR_COUNT];
    VkFormat formats[RG_COLOR_COUNT];
    VkPipelineRenderingCreateInfo rendering;
};

VkPipelineRenderingCreateInfo rg_exec_target_formats(const struct rg_exec *exec,
                                                     const struct rg_plan_pass *plan,
                                                     VkFormat formats[RG_COLOR_COUNT])
{
    const struct rg_plan_image *images = exec->plan->images;
    VkPipelineRenderingCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .viewMask = rg_exec_view_mask(plan->pass),
        .colorAttachmentCount = plan->color_count,
        .pColorAttachmentFormats = formats,
    };
    for (uint32_t i = 0; i < plan->color_count; i++)
        formats[i] = images[plan->color[i].image].image->format;
    if (plan->depth.image == RG_NONE)
        return info;
    const struct rg_plan_image *depth = &images[plan->depth.image];
    info.depthAttachmentFormat = depth->image->format;
    if (depth->aspects & VK_IMAGE_ASPECT_STENCIL_BIT)
        info.stencilAttachmentFormat = depth->image->format;
    return info;
}

static void fill_target_state(struct target_state *state, const struct rg_exec *exec,
                              const struct rg_plan_pass *plan)
{
    state->rendering = rg_exec_target_formats(exec, plan, state->formats);
    for (uint32_t i = 0; i < plan->color_count; i++)
        state->blends[i] = blend_state(&plan->pass->color[i]);
}

/* Vertex input state of a row. */
struct vertex_state {
    VkVertexInputBindingDescription bindings[RG_MAX_VERTEX_BUFFERS];
    VkVertexInputAttributeDescription attributes[RG_MAX_ATTRIBUTES];
    VkPipelineVertexInputStateCreateInfo info;
};

static void fill_vertex_state(struct vertex_state *state, const struct rg_vertex_layout *layout)
{
    uint32_t binding = 0, count = 0;
    for (; layout; layout = layout->next, binding++) {
        state->bindings[binding] =
            (VkVertexInputBindingDescription){ binding, layout->stride, layout->rate };
        for (uint32_t i = 0; i < layout->attribute_count; i++)
            state->attributes[count++] = layout->attributes[i];
    }
    state->info = (VkPipelineVertexInputStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = binding,
        .pVertexBindingDescriptions = state->bindings,
        .vertexAttributeDescriptionCount = count,
        .pVertexAttributeDescriptions = state->attributes,
    };
}

static VkPipelineRasterizationStateCreateInfo rasterization_of(const struct rg_pass *row)
{
    const struct rg_depth_bias *bias = &row->depth_bias;
    return (VkPipelineRasterizationStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = row->cull,
        .frontFace = row->front,
        .depthBiasEnable = bias->constant != 0.0f || bias->slope != 0.0f,
        .depthBiasConstantFactor = bias->constant,
        .depthBiasClamp = bias->clamp,
        .depthBiasSlopeFactor = bias->slope,
        .lineWidth = 1.0f,
    };
}

static VkPipelineDepthStencilStateCreateInfo depth_stencil_of(const struct rg_plan_pass *plan)
{
    const struct rg_pass *row = plan->pass;
    const bool has_depth = plan->depth.image != RG_NONE;
    return (VkPipelineDepthStencilStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = has_depth,
        .depthWriteEnable = has_depth && !row->depth_read_only,
        .depthCompareOp = row->depth_compare ? row->depth_compare : VK_COMPARE_OP_LESS_OR_EQUAL,
        .stencilTestEnable = row->stencil != NULL,
        .front = row->stencil ? row->stencil->front : (VkStencilOpState){ 0 },
        .back = row->stencil ? row->stencil->back : (VkStencilOpState){ 0 },
    };
}

/* Creates a graphics pipeline from one or two shader stages. */
static VkResult make_graphics(struct rg_exec *exec, const struct rg_plan_pass *plan,
                              struct exec_pass *pass, const VkPipelineShaderStageCreateInfo *stages)
{
    static const VkDynamicState dynamic[] = { VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR };
    const struct rg_pass *row = plan->pass;
    const VkPipelineRasterizationStateCreateInfo rasterization = rasterization_of(row);
    const VkPipelineDepthStencilStateCreateInfo depth_stencil = depth_stencil_of(plan);
    struct vertex_state vertices;
    struct target_state targets;
    fill_vertex_state(&vertices, row->vertices);
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
    info.pVertexInputState = &vertices.info;
    info.pInputAssemblyState = &(VkPipelineInputAssemblyStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = row->topology ? row->topology : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    };
    info.pViewportState = &(VkPipelineViewportStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1,
    };
    info.pRasterizationState = &rasterization;
    info.pMultisampleState = &(VkPipelineMultisampleStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = rg_exec_samples(exec, plan),
    };
    info.pDepthStencilState = &depth_stencil;
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
    RG_CALL(exec, row->name, CreateGraphicsPipelines, exec->device, exec->params.pipeline_cache, 1,
            &info, NULL, &pass->pipeline);
fail:
    return result;
}

/* ---- cache keys ---- */

/* Returns true if a shader (known to be valid SPIR-V) has a specialization constant. */
static bool has_constant(const struct rg_shader *code, uint32_t id)
{
    enum {
        HEADER_WORDS = 5,
        OP_FUNCTION = 54,
        OP_DECORATE = 71,
        SPEC_ID = 1,
    };

    uint32_t count;
    for (size_t i = HEADER_WORDS; i + 3 < code->word_count; i += count) {
        const uint32_t *words = &code->words[i];
        count = words[0] >> 16;
        if ((words[0] & 0xffff) == OP_FUNCTION || !count)
            return false;
        if ((words[0] & 0xffff) == OP_DECORATE && words[2] == SPEC_ID && words[3] == id)
            return true;
    }
    return false;
}

/* Adds the code of a shader and the specialization constants that it declares to the key. */
static void add_shader(struct rg_exec *exec, const struct rg_shader *shader)
{
    const VkSpecializationInfo *constants = exec->params.constants;
    const struct rg_shader *code = shader ? rg_exec_code(exec, shader) : NULL;
    RG_KEY(exec, code ? code->word_count : 0);
    if (!code || !code->words)
        return;
    rg_exec_key(exec, code->words, code->word_count * sizeof(uint32_t));
    for (uint32_t i = 0; constants && i < constants->mapEntryCount; i++) {
        const VkSpecializationMapEntry *entry = &constants->pMapEntries[i];
        if (!has_constant(code, entry->constantID))
            continue;
        RG_KEY(exec, entry->constantID);
        RG_KEY(exec, entry->size);
        rg_exec_key(exec, (const char *)constants->pData + entry->offset, entry->size);
    }
}

static void add_vertices(struct rg_exec *exec, const struct rg_vertex_layout *layout)
{
    for (; layout; layout = layout->next) {
        RG_KEY(exec, (uint64_t)layout->rate << 32 | layout->stride);
        RG_KEY(exec, layout->attribute_count);
        if (layout->attribute_count)
            rg_exec_key(exec, layout->attributes,
                        layout->attribute_count * sizeof(*layout->attributes));
    }
    RG_KEY(exec, UINT64_MAX);
}

/* Stores a pipeline's cache key. Passes with equal keys share one pipeline. The key ignores the
 * VkRenderPass, because passes with equal targets have compatible render passes. */
static void add_pipeline(struct rg_exec *exec, const struct rg_plan_pass *plan,
                         const struct exec_pass *pass)
{
    const struct rg_pass *row = plan->pass;
    RG_KEY(exec, pass->layout);
    add_shader(exec, row->vert);
    add_shader(exec, row->frag);
    add_shader(exec, row->comp);
    if (row->kind == RG_COMPUTE)
        return;
    const uint32_t state[] = { (uint32_t)row->topology,
                               row->cull,
                               (uint32_t)row->front,
                               (uint32_t)row->depth_compare,
                               row->depth_read_only,
                               plan->color_count,
                               (uint32_t)rg_exec_samples(exec, plan),
                               rg_exec_view_mask(row),
                               pass->render_pass != VK_NULL_HANDLE };
    struct target_state targets;
    add_vertices(exec, row->vertices);
    rg_exec_key(exec, state, sizeof(state));
    fill_target_state(&targets, exec, plan);
    rg_exec_key(exec, &row->depth_bias, sizeof(row->depth_bias));
    RG_KEY(exec, row->stencil != NULL);
    if (row->stencil)
        rg_exec_key(exec, row->stencil, sizeof(*row->stencil));
    for (uint32_t i = 0; i < plan->color_count; i++) {
        RG_KEY(exec, targets.formats[i]);
        rg_exec_key(exec, &targets.blends[i], sizeof(targets.blends[i]));
    }
    RG_KEY(exec, targets.rendering.depthAttachmentFormat);
}

static VkResult make_compute(struct rg_exec *exec, const struct rg_pass *row,
                             struct exec_pass *pass, const VkPipelineShaderStageCreateInfo *stage)
{
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = *stage,
        .layout = pass->layout,
    };
    VkResult result;
    RG_CALL(exec, row->name, CreateComputePipelines, exec->device, exec->params.pipeline_cache, 1,
            &info, NULL, &pass->pipeline);
fail:
    return result;
}

static VkResult make_pipeline(struct rg_exec *exec, const struct rg_plan_pass *plan,
                              struct exec_pass *pass)
{
    const struct rg_pass *row = plan->pass;
    VkPipelineShaderStageCreateInfo stages[2] = { 0 };
    VkResult result;
    RG_TRY(make_layout(exec, row, pass));
    if (!rg_exec_has_pipeline(row) && pass->render_pass)
        return rg_exec_check(exec, VK_ERROR_FEATURE_NOT_PRESENT,
                             "render_passes for a row without shaders: the pipeline", row->name);
    if (!rg_exec_has_pipeline(row))
        return VK_SUCCESS;
    add_pipeline(exec, plan, pass);
    RG_TRY(rg_exec_reserve_object(exec));
    if (rg_exec_find(exec, VK_OBJECT_TYPE_PIPELINE, &pass->pipeline, sizeof(pass->pipeline)))
        return VK_SUCCESS;
    if (row->kind == RG_COMPUTE) {
        RG_TRY(make_stage(exec, row->comp, VK_SHADER_STAGE_COMPUTE_BIT, &stages[0]));
        RG_TRY(make_compute(exec, row, pass, stages));
    } else {
        RG_TRY(make_stage(exec, row->vert, VK_SHADER_STAGE_VERTEX_BIT, &stages[0]));
        if (row->frag)
            RG_TRY(make_stage(exec, row->frag, VK_SHADER_STAGE_FRAGMENT_BIT, &stages[1]));
        RG_TRY(make_graphics(exec, plan, pass, stages));
    }
    rg_exec_add_object(exec, VK_OBJECT_TYPE_PIPELINE, (uint64_t)pass->pipeline, row->name);
fail:
    exec->vk.DestroyShaderModule(exec->device, stages[0].module, NULL);
    exec->vk.DestroyShaderModule(exec->device, stages[1].module, NULL);
    return result;
}

VkResult rg_exec_make_pipelines(struct rg_exec *exec)
{
    const struct rg_plan_pass *plans = exec->plan->passes;
    VkResult result = VK_SUCCESS;
    for (uint32_t p = 0; p < exec->plan->pass_count && result == VK_SUCCESS; p++) {
        struct exec_pass *pass = &exec->passes[p];
        bool repeats = p > 0 && plans[p - 1].pass == plans[p].pass;
        if (repeats) {
            pass->layout = exec->passes[p - 1].layout;
            pass->pipeline = exec->passes[p - 1].pipeline;
        } else if (plans[p].pass->kind != RG_TRANSFER) {
            result = make_pipeline(exec, &plans[p], pass);
        }
    }
    return result;
}

/* Returns the first pass of a row; NULL if the plan has none. */
static const struct exec_pass *find_pass(const struct rg_exec *exec, const struct rg_pass *row)
{
    for (uint32_t p = 0; p < exec->plan->pass_count; p++) {
        if (exec->plan->passes[p].pass == row)
            return &exec->passes[p];
    }
    return NULL;
}

VkPipelineLayout rg_exec_layout(const struct rg_exec *exec, const struct rg_pass *row)
{
    const struct exec_pass *pass = find_pass(exec, row);
    return pass ? pass->layout : VK_NULL_HANDLE;
}

VkDescriptorSetLayout rg_exec_set_layout(const struct rg_exec *exec, const struct rg_pass *row)
{
    const struct exec_pass *pass = find_pass(exec, row);
    return pass && pass->layout ? pass->set_layout : VK_NULL_HANDLE;
}
