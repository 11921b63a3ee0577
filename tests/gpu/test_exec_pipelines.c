/* test_exec_pipelines.c: rows without shaders and mixed rows, with pipelines of the program. */
#include "tests/support/assertions.h"

#include "tests/gpu/shaders/data.h"
#include "tests/support/lavapipe.h"
#include "tests/support/rectangle_rows.h"

enum {
    SEED = 5,
    TEXELS = 64,
};

static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_image own = COLOR_IMAGE("own");
static const struct rg_image mixed = COLOR_IMAGE("mixed");
static const struct rg_image texels = { .name = "texels", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer own_out = COLOR_BUFFER("own out");
static const struct rg_buffer mixed_out = COLOR_BUFFER("mixed out");
static const struct rg_buffer seed = { .name = "seed",
                                       .size = sizeof(struct data_seed),
                                       .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer numbers = { .name = "numbers",
                                          .size = TEXELS * sizeof(uint32_t),
                                          .memory = RG_MEMORY_READBACK };

enum {
    TESTED,  /* paints what passes the depth test */
    SAMPLED, /* adds the sampled depth to the colour */
    PLAIN,   /* paints in a row that has shaders, too */
    FILLED,  /* computes */
    PIPELINE_COUNT,
};

static VkPipeline pipelines[PIPELINE_COUNT];

static void record_near(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    painted_draw(cmd, &(struct paint_push){ LEFT_HALF, .depth = 0.25F });
}

static void record_own(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_bind_pipeline(cmd, pipelines[TESTED]);
    painted_draw(cmd, &(struct paint_push){ .color = { { 1, 0, 0, 1 } }, ALL, .depth = 0.5F });
    rg_cmd_bind_pipeline(cmd, pipelines[SAMPLED]);
    painted_draw(cmd, &(struct paint_push){ .color = { { 0, 2, 0, 0 } }, TOP_HALF });
}

static void record_mixed(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    painted_draw(cmd, &(struct paint_push){ .color = { { 0, 0, 3, 0 } }, TOP_HALF });
    rg_cmd_bind_pipeline(cmd, pipelines[PLAIN]);
    painted_draw(cmd, &(struct paint_push){ .color = { { 4, 0, 0, 0 } }, LEFT_HALF });
}

static void record_fill(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    vkCmdBindPipeline(rg_cmd_vulkan(cmd), VK_PIPELINE_BIND_POINT_COMPUTE, pipelines[FILLED]);
    rg_cmd_dispatch(cmd, 8 / DATA_GROUP, 8 / DATA_GROUP, 1);
}

static const struct rg_pass rows[] = {
    {
        .name = "near",
        .depth = { &depth, RG_LOAD_CLEAR, .clear.depthStencil.depth = 1 },
        PAINTED_BY(record_near, NULL),
    },
    {
        .name = "own",
        .color = RG_TARGETS({ &own, RG_LOAD_CLEAR }),
        .depth = { &depth },
        .depth_read_only = true,
        .uses = RG_USES({ .image = &depth, .access = RG_SAMPLED, .binding = PAINT_SOURCE }),
        .push_size = sizeof(struct paint_push),
        .record = record_own,
    },
    {
        .name = "mixed",
        .color = RG_TARGETS({ &mixed, RG_LOAD_CLEAR }),
        PAINTED_BY(record_mixed, &paint_frag),
    },
    {
        .name = "fill",
        .kind = RG_COMPUTE,
        .uses = RG_USES({ .buffer = &seed, .access = RG_UNIFORM, .binding = DATA_SEED },
                        { .buffer = &numbers, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS },
                        { .image = &texels, .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS }),
        .record = record_fill,
    },
    RUN_READ("read own", own, own_out),
    RUN_READ("read mixed", mixed, mixed_out),
};

/* ---- pipelines of the program ---- */

static VkPipelineShaderStageCreateInfo stage(const struct gpu *gpu, VkShaderStageFlagBits bit,
                                             const struct rg_shader *shader)
{
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = shader->word_count * sizeof(uint32_t),
        .pCode = shader->words,
    };
    VkPipelineShaderStageCreateInfo out = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = bit,
        .pName = "main",
    };
    assert_int_equal(vkCreateShaderModule(gpu->device, &info, NULL, &out.module), VK_SUCCESS);
    return out;
}

static const VkPipelineVertexInputStateCreateInfo no_vertices = {
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
};

static VkPipeline draw_pipeline(const struct gpu *gpu, VkPipelineLayout layout,
                                const struct rg_shader *frag, bool has_depth, bool tests)
{
    static const VkDynamicState dynamic[] = { VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR };
    const VkPipelineShaderStageCreateInfo stages[] = {
        stage(gpu, VK_SHADER_STAGE_VERTEX_BIT, &paint_vert),
        stage(gpu, VK_SHADER_STAGE_FRAGMENT_BIT, frag),
    };
    const VkPipelineRenderingCreateInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = 1,
        .pColorAttachmentFormats = &own.format,
        .depthAttachmentFormat = has_depth ? depth.format : VK_FORMAT_UNDEFINED,
    };
    const VkPipelineDepthStencilStateCreateInfo depth_stencil = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = tests,
        .depthCompareOp = VK_COMPARE_OP_LESS,
    };
    VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = &rendering,
        .stageCount = 2,
        .pStages = stages,
        .layout = layout,
    };
    info.pVertexInputState = &no_vertices;
    info.pInputAssemblyState = &(VkPipelineInputAssemblyStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    };
    info.pViewportState = &(VkPipelineViewportStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1,
    };
    info.pRasterizationState = &(VkPipelineRasterizationStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .lineWidth = 1,
    };
    info.pMultisampleState = &(VkPipelineMultisampleStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT,
    };
    info.pDepthStencilState = &depth_stencil;
    info.pColorBlendState = &(VkPipelineColorBlendStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &(VkPipelineColorBlendAttachmentState){ .colorWriteMask = 0xf },
    };
    info.pDynamicState = &(VkPipelineDynamicStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = 2,
        .pDynamicStates = dynamic,
    };
    VkPipeline pipeline = VK_NULL_HANDLE;
    vkCreateGraphicsPipelines(gpu->device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline);
    assert_non_null(pipeline);
    for (int i = 0; i < 2; i++)
        vkDestroyShaderModule(gpu->device, stages[i].module, NULL);
    return pipeline;
}

static void make_pipelines(const struct gpu *gpu, const struct rg_exec *exec)
{
    const VkComputePipelineCreateInfo fill = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = stage(gpu, VK_SHADER_STAGE_COMPUTE_BIT, &fill_comp),
        .layout = rg_exec_layout(exec, &rows[3]),
    };
    const VkPipelineLayout layout = rg_exec_layout(exec, &rows[1]);
    pipelines[TESTED] = draw_pipeline(gpu, layout, &paint_frag, true, true);
    pipelines[SAMPLED] = draw_pipeline(gpu, layout, &fetch_frag, true, false);
    pipelines[PLAIN] =
        draw_pipeline(gpu, rg_exec_layout(exec, &rows[2]), &paint_frag, false, false);
    assert_int_equal(
        vkCreateComputePipelines(gpu->device, VK_NULL_HANDLE, 1, &fill, NULL, &pipelines[FILLED]),
        VK_SUCCESS);
    vkDestroyShaderModule(gpu->device, fill.stage.module, NULL);
}

/* ---- the test ---- */

static void check(struct run *run)
{
    const uint32_t *found = run_data(run, &numbers);
    for (uint32_t i = 0; i < TEXELS; i++) {
        const bool left = i % 8 < 4, top = i < 32;
        painted_check(run, &own_out, i,
                      top    ? painted_color(left ? 0.25F : 1, 2, 0, 1)
                      : left ? painted_color(0, 0, 0, 0)
                             : painted_color(1, 0, 0, 1));
        painted_check(run, &mixed_out, i,
                      left  ? painted_color(4, 0, 0, 0)
                      : top ? painted_color(0, 0, 3, 0)
                            : painted_color(0, 0, 0, 0));
        assert_int_equal(found[i], 3 * (SEED + i));
    }
}

/* rg_exec_view() works before the first frame and returns the same view again. It returns
 * VK_NULL_HANDLE for images that the plan does not have, and for wrong ranges. */
static void check_views(struct rg_exec *exec)
{
    static const struct rg_image other = COLOR_IMAGE("other");
    const struct rg_range beyond = { .mip = 1 };
    const VkImageView view = rg_exec_view(exec, &depth, NULL);
    assert_true(view && view == rg_exec_view(exec, &depth, NULL));
    assert_true(rg_exec_view(exec, &own, NULL) != view);
    assert_null(rg_exec_view(exec, &other, NULL));
    assert_null(rg_exec_view(exec, &own, &beyond));
    assert_true(rg_exec_set_layout(exec, &rows[1]) && !rg_exec_set_layout(exec, &rows[4]));
}

static void own_pipelines_draw(void **state)
{
    struct gpu *gpu = *state;
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", rows),
        .outputs = { &own_out, &mixed_out, &numbers },
    };
    for (int sharing = RG_SHARE_FEWEST_BATCHES; sharing <= RG_SHARE_NOTHING; sharing++) {
        struct run_params now = params;
        struct run run;
        now.sharing = (enum rg_sharing)sharing;
        run_open(&run, gpu, &now);
        check_views(run.exec);
        make_pipelines(gpu, run.exec);
        for (int frame = 0; frame < 3; frame++) {
            assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
            *(struct data_seed *)run_data(&run, &seed) = (struct data_seed){ SEED };
            assert_int_equal(rg_exec_submit(run.exec, NULL), VK_SUCCESS);
            assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
            check(&run);
        }
        run_close(&run);
        for (int i = 0; i < PIPELINE_COUNT; i++)
            vkDestroyPipeline(gpu->device, pipelines[i], NULL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(own_pipelines_draw),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
