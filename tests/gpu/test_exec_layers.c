/* test_exec_layers.c: rows that draw several layers at a time: layers that the vertex shader
 * chooses, and views of multiview rendering, which secondary command buffers may draw. */
#include "tests/support/all_features_device.h"
#include "tests/support/assertions.h"
#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

enum {
    LAYER_COUNT = 3
};

static const struct rg_image stack = COLOR_IMAGE("stack", .layers = LAYER_COUNT + 1);
static const struct rg_buffer stack_out = {
    .name = "stack out",
    .size_per_texel = (LAYER_COUNT + 1) * 4 * sizeof(float),
    .memory = RG_MEMORY_READBACK,
};

static void record_nothing(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
}

static void record_layers(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw_instances(cmd, 3, LAYER_COUNT);
}

static void record_views(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw(cmd, 4);
}

static VkCommandBuffer secondary;

static void draw_views(struct rg_cmd *cmd, void *user)
{
    (void)user;
    rg_cmd_draw(cmd, 4);
}

static void record_secondary_views(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    assert_int_equal(rg_cmd_record_secondary(cmd, secondary, draw_views, NULL), VK_SUCCESS);
    rg_cmd_execute(cmd, &secondary, 1);
}

/* Layer 0 is cleared, and the others are drawn at a time. */
#define CLEAR \
    { \
        .name = "clear", \
        .color = RG_TARGETS({ &stack, RG_LOAD_CLEAR, { .color = { { 9, 0, 0, 1 } } } }), \
        .vert = &layer_vert, .frag = &layer_frag, .record = record_nothing, \
    }
#define DRAW(shader, function, ...) \
    { \
        .name = "draw", .color = RG_TARGETS({ &stack, RG_LOAD_DISCARD, .layer = 1 }), \
        .vert = &(shader), .frag = &layer_frag, .record = (function), .layers = LAYER_COUNT, \
        __VA_ARGS__ \
    }

static const struct rg_pass rows[] = {
    CLEAR,
    DRAW(layer_vert, record_layers, .queue = RG_QUEUE_MAIN),
    RUN_READ("read", stack, stack_out),
};
static const struct rg_pass view_rows[] = {
    CLEAR,
    DRAW(view_vert, record_views, .multiview = true,
         .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP),
    RUN_READ("read", stack, stack_out),
};
static const struct rg_pass secondary_view_rows[] = {
    CLEAR,
    DRAW(view_vert, record_secondary_views, .multiview = true, .secondary = true,
         .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP),
    RUN_READ("read", stack, stack_out),
};

static void check_layers(struct run *run)
{
    for (uint32_t i = 0; i < FEATURE_TEXELS * (LAYER_COUNT + 1); i++) {
        const uint32_t layer = i / FEATURE_TEXELS;
        painted_check(run, &stack_out, i, painted_color(layer ? (float)layer : 9.0F, 0, 0, 1));
    }
}

static void run_rows(void *state, const struct rg_technique *technique)
{
    const struct run_params params = { .technique = *technique, .outputs = { &stack_out } };
    struct gpu gpu;
    VkCommandBufferAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .level = VK_COMMAND_BUFFER_LEVEL_SECONDARY,
        .commandBufferCount = 1,
    };
    all_features_device_open(&gpu, state);
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
        .queueFamilyIndex = gpu.queue_family,
    };
    assert_int_equal(vkCreateCommandPool(gpu.device, &pool, NULL, &info.commandPool), VK_SUCCESS);
    assert_int_equal(vkAllocateCommandBuffers(gpu.device, &info, &secondary), VK_SUCCESS);
    run_variants(&gpu, &params, NULL, check_layers);
    vkDestroyCommandPool(gpu.device, info.commandPool, NULL);
    all_features_device_close(&gpu);
}

static void layers_are_drawn_at_a_time(void **state)
{
    run_rows(*state, &(struct rg_technique)RG_TECHNIQUE("layers", rows));
}

static void views_are_drawn_at_a_time(void **state)
{
    run_rows(*state, &(struct rg_technique)RG_TECHNIQUE("views", view_rows));
}

static void secondary_buffers_draw_views(void **state)
{
    run_rows(*state, &(struct rg_technique)RG_TECHNIQUE("views", secondary_view_rows));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(layers_are_drawn_at_a_time),
        ON_DEVICE(views_are_drawn_at_a_time),
        ON_DEVICE(secondary_buffers_draw_views),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
