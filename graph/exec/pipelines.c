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
    RG_MAKE(exec, row->name, CreatePipelineLayout, &pass->layout,
            &(VkPipelineLayoutCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                .setLayoutCount = 1,
                .pSetLayouts = &pass->set_layout,
                .pushConstantRangeCount = row->push_size ? 1 : 0,
                .pPushConstantRanges = &push,
            });
    rg_exec_name(exec, VK_OBJECT_TYPE_PIPELINE_LAYOUT, (uint64_t)pass->layout, row->name);
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
    VkResult result;
    *info = (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = stage,
        .pName = "main",
        .pSpecializationInfo = params->constants,
    };
    RG_MAKE(exec, shader->name, CreateShaderModule, &info->module,
            &(VkShaderModuleCreateInfo){
                .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                .codeSize = code->word_count * sizeof(uint32_t),
                .pCode = code->words,
            });
    rg_exec_name(exec, VK_OBJECT_TYPE_SHADER_MODULE, (uint64_t)info->module, shader->name);
fail:
    return result;
}

static VkPipelineColorBlendAttachmentState blend_state(enum rg_blend blend)
{
    return (VkPipelineColorBlendAttachmentState){
        .blendEnable = blend != RG_BLEND_NONE,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor =
            blend == RG_BLEND_ADD ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor =
            blend == RG_BLEND_ADD ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
        .colorWriteMask = 0xf,
    };
}

/* The fixed-function state of a row; everything a VkGraphicsPipelineCreateInfo points to. */
struct raster_state {
    VkVertexInputBindingDescription binding;
    VkPipelineVertexInputStateCreateInfo vertices;
    VkPipelineInputAssemblyStateCreateInfo assembly;
    VkPipelineViewportStateCreateInfo viewport;
    VkPipelineRasterizationStateCreateInfo rasterization;
    VkPipelineMultisampleStateCreateInfo samples;
    VkPipelineDepthStencilStateCreateInfo depth;
    VkPipelineColorBlendAttachmentState blends[RG_COLOR_COUNT];
    VkPipelineColorBlendStateCreateInfo blend;
    VkDynamicState dynamic_states[2];
    VkPipelineDynamicStateCreateInfo dynamic;
    VkFormat formats[RG_COLOR_COUNT];
    VkPipelineRenderingCreateInfo rendering;
};

static void fill_geometry(struct raster_state *s, const struct rg_pass *row)
{
    const struct rg_vertex_layout *layout = row->vertices;
    if (layout)
        s->binding = (VkVertexInputBindingDescription){ .stride = layout->stride };
    s->vertices = (VkPipelineVertexInputStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = layout ? 1 : 0,
        .pVertexBindingDescriptions = &s->binding,
        .vertexAttributeDescriptionCount = layout ? layout->attribute_count : 0,
        .pVertexAttributeDescriptions = layout ? layout->attributes : NULL,
    };
    s->assembly = (VkPipelineInputAssemblyStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = row->topology ? row->topology : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    };
    s->viewport = (VkPipelineViewportStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1,
    };
    s->rasterization = (VkPipelineRasterizationStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = row->cull,
        .frontFace = row->front,
        .lineWidth = 1.0f,
    };
}

static void fill_targets(struct raster_state *s, const struct rg_exec *exec,
                         const struct rg_plan_pass *plan)
{
    const struct rg_pass *row = plan->pass;
    const struct rg_plan_image *images = exec->plan->images;
    bool has_depth = plan->depth.image != RG_NONE;
    for (uint32_t i = 0; i < plan->color_count; i++) {
        s->blends[i] = blend_state(row->color[i].blend);
        s->formats[i] = images[plan->color[i].image].image->format;
    }
    s->samples = (VkPipelineMultisampleStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = rg_exec_samples(exec, plan),
    };
    s->depth = (VkPipelineDepthStencilStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = has_depth,
        .depthWriteEnable = has_depth && !row->depth_read_only,
        .depthCompareOp = row->depth_compare ? row->depth_compare : VK_COMPARE_OP_LESS_OR_EQUAL,
    };
    s->blend = (VkPipelineColorBlendStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = plan->color_count,
        .pAttachments = s->blends,
    };
    s->dynamic_states[0] = VK_DYNAMIC_STATE_VIEWPORT;
    s->dynamic_states[1] = VK_DYNAMIC_STATE_SCISSOR;
    s->dynamic = (VkPipelineDynamicStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2,
        .pDynamicStates = s->dynamic_states,
    };
    VkFormat depth = has_depth ? images[plan->depth.image].image->format : VK_FORMAT_UNDEFINED;
    bool stencil = has_depth && images[plan->depth.image].aspects & VK_IMAGE_ASPECT_STENCIL_BIT;
    s->rendering = (VkPipelineRenderingCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = plan->color_count,
        .pColorAttachmentFormats = s->formats,
        .depthAttachmentFormat = depth,
        .stencilAttachmentFormat = stencil ? depth : VK_FORMAT_UNDEFINED,
    };
}

static VkResult make_raster(struct rg_exec *exec, const struct rg_plan_pass *plan,
                            struct exec_pass *pass)
{
    const struct rg_pass *row = plan->pass;
    VkPipelineShaderStageCreateInfo stages[2] = { 0 };
    struct raster_state s = { 0 };
    VkResult result;
    fill_geometry(&s, row);
    fill_targets(&s, exec, plan);
    RG_PASS(make_stage(exec, row->vert, VK_SHADER_STAGE_VERTEX_BIT, &stages[0]));
    if (row->frag)
        RG_PASS(make_stage(exec, row->frag, VK_SHADER_STAGE_FRAGMENT_BIT, &stages[1]));
    const VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = pass->render_pass ? NULL : &s.rendering,
        .stageCount = row->frag ? 2 : 1,
        .pStages = stages,
        .pVertexInputState = &s.vertices,
        .pInputAssemblyState = &s.assembly,
        .pViewportState = &s.viewport,
        .pRasterizationState = &s.rasterization,
        .pMultisampleState = &s.samples,
        .pDepthStencilState = &s.depth,
        .pColorBlendState = &s.blend,
        .pDynamicState = &s.dynamic,
        .layout = pass->layout,
        .renderPass = pass->render_pass,
    };
    RG_CALL(exec, row->name, CreateGraphicsPipelines, exec->device, exec->params.pipeline_cache, 1,
            &info, NULL, &pass->pipeline);
fail:
    exec->vk.DestroyShaderModule(exec->device, stages[0].module, NULL);
    exec->vk.DestroyShaderModule(exec->device, stages[1].module, NULL);
    return result;
}

static VkResult make_compute(struct rg_exec *exec, const struct rg_pass *row,
                             struct exec_pass *pass)
{
    VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .layout = pass->layout,
    };
    VkResult result;
    RG_PASS(make_stage(exec, row->comp, VK_SHADER_STAGE_COMPUTE_BIT, &info.stage));
    RG_CALL(exec, row->name, CreateComputePipelines, exec->device, exec->params.pipeline_cache, 1,
            &info, NULL, &pass->pipeline);
fail:
    exec->vk.DestroyShaderModule(exec->device, info.stage.module, NULL);
    return result;
}

static VkResult make_pipeline(struct rg_exec *exec, const struct rg_plan_pass *plan,
                              struct exec_pass *pass)
{
    const struct rg_pass *row = plan->pass;
    VkResult result = VK_SUCCESS;
    if (row->kind == RG_TRANSFER)
        return VK_SUCCESS;
    RG_PASS(make_layout(exec, row, pass));
    if (row->kind == RG_COMPUTE)
        RG_PASS(make_compute(exec, row, pass));
    else
        RG_PASS(make_raster(exec, plan, pass));
    rg_exec_name(exec, VK_OBJECT_TYPE_PIPELINE, (uint64_t)pass->pipeline, row->name);
fail:
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

/* Whether two rows can share a pipeline. Rows with the same uses have compatible set layouts. */
static bool draw_alike(const struct rg_exec *exec, const struct rg_plan_pass *a,
                       const struct rg_plan_pass *b)
{
    const struct rg_pass *x = a->pass, *y = b->pass;
    bool same = x->vert == y->vert && x->frag == y->frag && x->uses == y->uses &&
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

/* Finds an earlier row to share the pipeline with, since drivers compile equal pipelines again. A
 * pipeline made for a VkRenderPass is not shared. */
static bool find_alike(const struct rg_exec *exec, uint32_t p, struct exec_pass *pass)
{
    const struct rg_plan_pass *passes = exec->plan->passes;
    for (uint32_t q = 0; q < p && passes[p].pass->kind == RG_RASTER && !pass->render_pass; q++) {
        if (exec->passes[q].owner && passes[q].pass->kind == RG_RASTER &&
            draw_alike(exec, &passes[p], &passes[q])) {
            pass->layout = exec->passes[q].layout;
            pass->pipeline = exec->passes[q].pipeline;
            return true;
        }
    }
    return false;
}

VkResult rg_exec_make_pipelines(struct rg_exec *exec)
{
    VkResult result = VK_SUCCESS;
    for (uint32_t p = 0; p < exec->plan->pass_count && result == VK_SUCCESS; p++) {
        struct exec_pass *pass = &exec->passes[p];
        if (pass->owner) {
            pass->shares = find_alike(exec, p, pass);
            if (!pass->shares)
                result = make_pipeline(exec, &exec->plan->passes[p], pass);
        } else {
            pass->layout = exec->passes[p - 1].layout;
            pass->pipeline = exec->passes[p - 1].pipeline;
        }
    }
    return result;
}

void rg_exec_free_pipelines(struct rg_exec *exec)
{
    for (uint32_t p = 0; p < exec->plan->pass_count; p++) {
        if (!exec->passes[p].owner || exec->passes[p].shares)
            continue;
        exec->vk.DestroyPipeline(exec->device, exec->passes[p].pipeline, NULL);
        exec->vk.DestroyPipelineLayout(exec->device, exec->passes[p].layout, NULL);
    }
}
