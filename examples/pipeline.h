/* pipeline.h: a graphics pipeline of an example for a row without shaders (C17 and C++20). */
#ifndef PIPELINE_H
#define PIPELINE_H

#include "example.h"

static inline VkShaderModule pipeline_module(VkDevice device, const struct rg_shader *shader)
{
    VkShaderModule module = VK_NULL_HANDLE;
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = 4 * shader->word_count,
        .pCode = shader->words,
    };
    vkCreateShaderModule(device, &info, NULL, &module);
    return module;
}

/* Creates a pipeline for a row's targets and layout, with depth test and without vertex buffers.
 * `variant` is the value of specialization constant 0. Returns VK_NULL_HANDLE on failure. */
static inline VkPipeline pipeline_create(VkDevice device, const struct rg_exec *exec,
                                         const struct rg_pass *row, const struct rg_shader *vert,
                                         const struct rg_shader *frag, uint32_t variant)
{
    static const VkDynamicState dynamic[] = { VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR };
    const VkSpecializationMapEntry entry = { .size = sizeof(variant) };
    const VkSpecializationInfo constants = { 1, &entry, sizeof(variant), &variant };
    VkPipelineShaderStageCreateInfo stages[2] = {
        { .stage = VK_SHADER_STAGE_VERTEX_BIT, .module = pipeline_module(device, vert) },
        { .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
          .module = pipeline_module(device, frag),
          .pSpecializationInfo = &constants },
    };
    VkPipelineColorBlendAttachmentState blends[RG_COLOR_COUNT] = { { 0 } };
    VkFormat formats[RG_COLOR_COUNT];
    for (int i = 0; i < 2; i++) {
        stages[i].sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stages[i].pName = "main";
    }
    for (uint32_t i = 0; i < row->color_count; i++) {
        formats[i] = row->color[i].image->format;
        blends[i].colorWriteMask = 0xf;
    }
    const VkPipelineRenderingCreateInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = row->color_count,
        .pColorAttachmentFormats = formats,
        .depthAttachmentFormat = row->depth.image->format,
    };
    const VkPipelineVertexInputStateCreateInfo vertices = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
    };
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    };
    const VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1,
    };
    const VkPipelineRasterizationStateCreateInfo rasterization = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .lineWidth = 1.0f,
    };
    const VkPipelineMultisampleStateCreateInfo samples = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT,
    };
    const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = VK_TRUE,
        .depthWriteEnable = VK_TRUE,
        .depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL,
    };
    const VkPipelineColorBlendStateCreateInfo blend = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = row->color_count,
        .pAttachments = blends,
    };
    const VkPipelineDynamicStateCreateInfo states = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2,
        .pDynamicStates = dynamic,
    };
    const VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = &rendering,
        .stageCount = 2,
        .pStages = stages,
        .pVertexInputState = &vertices,
        .pInputAssemblyState = &assembly,
        .pViewportState = &viewport,
        .pRasterizationState = &rasterization,
        .pMultisampleState = &samples,
        .pDepthStencilState = &depth,
        .pColorBlendState = &blend,
        .pDynamicState = &states,
        .layout = rg_exec_layout(exec, row),
    };
    VkPipeline pipeline = VK_NULL_HANDLE;
    vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline);
    vkDestroyShaderModule(device, stages[0].module, NULL);
    vkDestroyShaderModule(device, stages[1].module, NULL);
    return pipeline;
}

#endif
