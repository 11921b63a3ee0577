/* by_hand_pipeline.c: descriptors and pipelines. */
#include "tests/bench/frame/by_hand_private.h"

#include "src/tech/frame_resources.h"

static VkShaderModule make_module(const struct by_hand *h, const struct rg_shader *shader)
{
    VkShaderModule module;
    VK(vkCreateShaderModule(h->device,
                            &(VkShaderModuleCreateInfo){
                                .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                .codeSize = shader->word_count * sizeof(uint32_t),
                                .pCode = shader->words,
                            },
                            NULL, &module));
    return module;
}

static void make_set(struct by_hand *h, struct pipeline *p, const struct pipeline_row *row)
{
    VkDescriptorSetLayoutBinding layout[BINDING_COUNT];
    VkDescriptorImageInfo images[BINDING_COUNT];
    VkWriteDescriptorSet writes[BINDING_COUNT];
    const VkDescriptorBufferInfo globals = { h->buffers[0], 0, VK_WHOLE_SIZE };
    for (uint32_t i = 0; i < row->binding_count; i++) {
        const struct binding *b = &row->bindings[i];
        layout[i] = (VkDescriptorSetLayoutBinding){
            .binding = b->number,
            .descriptorType = b->image ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                       : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
            .descriptorCount = 1,
            .stageFlags = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
        };
        images[i] = (VkDescriptorImageInfo){ h->samplers[b->sampler], b->image,
                                             VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL };
    }
    VK(vkCreateDescriptorSetLayout(h->device,
                                   &(VkDescriptorSetLayoutCreateInfo){
                                       .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                       .bindingCount = row->binding_count,
                                       .pBindings = layout,
                                   },
                                   NULL, &p->set_layout));
    VK(vkAllocateDescriptorSets(h->device,
                                &(VkDescriptorSetAllocateInfo){
                                    .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                    .descriptorPool = h->descriptors,
                                    .descriptorSetCount = 1,
                                    .pSetLayouts = &p->set_layout,
                                },
                                &p->set));
    for (uint32_t i = 0; i < row->binding_count; i++)
        writes[i] = (VkWriteDescriptorSet){
            .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
            .dstSet = p->set,
            .dstBinding = layout[i].binding,
            .descriptorCount = 1,
            .descriptorType = layout[i].descriptorType,
            .pImageInfo = &images[i],
            .pBufferInfo = &globals,
        };
    vkUpdateDescriptorSets(h->device, row->binding_count, writes, 0, NULL);
}

static void make_layout(struct by_hand *h, struct pipeline *p, uint32_t push_size)
{
    const VkPushConstantRange push = {
        VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
        0,
        push_size,
    };
    VK(vkCreatePipelineLayout(h->device,
                              &(VkPipelineLayoutCreateInfo){
                                  .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                  .setLayoutCount = 1,
                                  .pSetLayouts = &p->set_layout,
                                  .pushConstantRangeCount = push_size ? 1 : 0,
                                  .pPushConstantRanges = &push,
                              },
                              NULL, &p->layout));
}

static void make_stages(const struct by_hand *h, const struct pipeline_row *row,
                        const VkSpecializationInfo *constants,
                        VkPipelineShaderStageCreateInfo stages[static 2])
{
    for (uint32_t i = 0; i < 2; i++)
        stages[i] = (VkPipelineShaderStageCreateInfo){
            .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = i ? VK_SHADER_STAGE_FRAGMENT_BIT : VK_SHADER_STAGE_VERTEX_BIT,
            .module = make_module(h, i ? row->frag : row->vert),
            .pName = "main",
            .pSpecializationInfo = constants,
        };
}

/* Everything fixed that all pipelines have alike. */
static const VkPipelineInputAssemblyStateCreateInfo assembly = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
};
static const VkPipelineViewportStateCreateInfo viewport = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
    .viewportCount = 1,
    .scissorCount = 1,
};
static const VkPipelineMultisampleStateCreateInfo samples = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
    .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT,
};
static const VkDynamicState dynamic_states[2] = { VK_DYNAMIC_STATE_VIEWPORT,
                                                  VK_DYNAMIC_STATE_SCISSOR };
static const VkPipelineDynamicStateCreateInfo dynamic = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
    .dynamicStateCount = 2,
    .pDynamicStates = dynamic_states,
};
static const VkPipelineColorBlendAttachmentState blends[2] = { { .colorWriteMask = 0xf },
                                                               { .colorWriteMask = 0xf } };

static void make_raster(const struct by_hand *h, struct pipeline *p, const struct pipeline_row *row,
                        const VkPipelineShaderStageCreateInfo stages[static 2])
{
    const uint32_t color_count = row->colors[1] ? 2 : 1;
    const VkFormat formats[2] = { by_hand_images[row->colors[0]].format,
                                  by_hand_images[row->colors[1]].format };
    const VkVertexInputBindingDescription vertices = { .stride = frame_mesh_layout.stride };
    const VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext =
            &(VkPipelineRenderingCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                .colorAttachmentCount = color_count,
                .pColorAttachmentFormats = formats,
                .depthAttachmentFormat = row->compare ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_UNDEFINED,
            },
        .stageCount = 2,
        .pStages = stages,
        .pVertexInputState =
            &(VkPipelineVertexInputStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
                .vertexBindingDescriptionCount = row->mesh,
                .pVertexBindingDescriptions = &vertices,
                .vertexAttributeDescriptionCount =
                    row->mesh ? frame_mesh_layout.attribute_count : 0,
                .pVertexAttributeDescriptions = frame_mesh_layout.attributes,
            },
        .pInputAssemblyState = &assembly,
        .pViewportState = &viewport,
        .pRasterizationState =
            &(VkPipelineRasterizationStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
                .cullMode = row->cull,
                .lineWidth = 1.0F,
            },
        .pMultisampleState = &samples,
        .pDepthStencilState =
            &(VkPipelineDepthStencilStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
                .depthTestEnable = row->compare != VK_COMPARE_OP_NEVER,
                .depthWriteEnable = row->compare && !row->reads_depth,
                .depthCompareOp = row->compare,
            },
        .pColorBlendState =
            &(VkPipelineColorBlendStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                .attachmentCount = color_count,
                .pAttachments = blends,
            },
        .pDynamicState = &dynamic,
        .layout = p->layout,
    };
    VK(vkCreateGraphicsPipelines(h->device, VK_NULL_HANDLE, 1, &info, NULL, &p->pipeline));
}

void by_hand_make_pipeline(struct by_hand *h, struct pipeline *p, const struct pipeline_row *row,
                           const VkSpecializationInfo *constants)
{
    VkPipelineShaderStageCreateInfo stages[2];
    make_set(h, p, row);
    make_layout(h, p, row->push_size);
    make_stages(h, row, constants, stages);
    make_raster(h, p, row, stages);
    vkDestroyShaderModule(h->device, stages[0].module, NULL);
    vkDestroyShaderModule(h->device, stages[1].module, NULL);
}

void by_hand_free_pipeline(const struct by_hand *h, const struct pipeline *p)
{
    vkDestroyPipeline(h->device, p->pipeline, NULL);
    vkDestroyPipelineLayout(h->device, p->layout, NULL);
    vkDestroyDescriptorSetLayout(h->device, p->set_layout, NULL);
}
