/* test_exec_samples.c: targets of four samples a texel: what they resolve to, and one by one. */
#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

#include <cglm/struct.h>

enum {
    FRAMES = 5,
    SAMPLES = 4,
    HALF_TEXELS = FEATURE_TEXELS / 4, /* of half the view a side */
};

/* Vulkan's standard sample locations, in a texel. */
static const double locations[SAMPLES][2] = {
    { 0.375, 0.125 },
    { 0.875, 0.375 },
    { 0.125, 0.625 },
    { 0.625, 0.875 },
};

/* The upper left of the target: as wide as it is, seven eighths as high. No edge meets a sample. */
#define TRIANGLE .from = { { -1, -1 } }, .to = { { 1, 0.75F } }

static bool is_covered(uint32_t texel, uint32_t side, uint32_t sample)
{
    const uint32_t column = texel % side;
    const uint32_t row = texel / side;
    return 7 * (column + locations[sample][0]) + 8 * (row + locations[sample][1]) < 7 * side;
}

/* How much of a texel, 0 ... 1. */
static float coverage(uint32_t texel, uint32_t side)
{
    float sum = 0;
    for (uint32_t i = 0; i < SAMPLES; i++)
        sum += is_covered(texel, side, i) ? 1.0F / SAMPLES : 0;
    return sum;
}

static vec4s mixed(vec4s color, vec4s behind, float share)
{
    return glms_vec4_add(glms_vec4_scale(color, share), glms_vec4_scale(behind, 1 - share));
}

static const vec4s eights = { { 8, 8, 8, 8 } };

/* ---- resolved ---- */

/* Before version 23 the driver takes every layer for the first one when it resolves. */
static bool resolves_layers(const struct run *run)
{
    return run->gpu->properties.driverVersion >= VK_MAKE_VERSION(23, 0, 0);
}

static void begin_resolve(struct run *run, uint32_t number, struct rg_frame *frame)
{
    static const struct paint_push paints[RESOLVE_PAINT_COUNT] = {
        [RESOLVE_TRIANGLE] = { .color = { { 4, 12, 16, 40 } }, TRIANGLE, .depth = 0.25F },
        [RESOLVE_OTHER] = { .color = { { 80, 32, 24, 8 } }, TRIANGLE },
        [RESOLVE_PART] = { .color = { { 40, 16, 12, 4 } }, TRIANGLE },
        [RESOLVE_LAYERS] = { .color = { { 100, 4, 0, 0 } }, TRIANGLE },
        [RESOLVE_TWO] = { .color = { { 1, 2, 3, 4 } }, ALL },
        [RESOLVE_KEEP] = { .color = { { 4, 8, 0, 0 } }, TRIANGLE },
        [RESOLVE_NUMBERS] = { .color = { { 77, 0, 0, 0 } }, ALL },
    };
    (void)run;
    (void)number;
    frame->paints = paints;
}

/* In a VkRenderPass it is the driver that chooses one of an integer's samples. */
static void check_integers(struct run *run)
{
    const uint32_t *numbers = run_data(run, run->params.outputs[RESOLVE_NUMBERS_OUT]);
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        if (numbers[i] != 77 && !(run->params.render_passes && numbers[i] == 1000))
            fail_msg("texel %u is %u%s", i, numbers[i],
                     run->params.render_passes ? ", in a VkRenderPass" : "");
    }
}

static VkAttachmentStoreOp store_of(const struct run *run, uint32_t row)
{
    const struct rg_plan *plan = run->plan;
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        if (plan->passes[i].row == row)
            return plan->passes[i].color[0].store;
    }
    fail_msg("row %u is not in the plan", row);
    return VK_ATTACHMENT_STORE_OP_MAX_ENUM;
}

static void check_resolve(struct run *run, uint32_t number)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    const float frames = (float)(number + 1);
    const bool all = resolves_layers(run);
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        const float share = coverage(i, FEATURE_SIZE);
        painted_check(run, outputs[RESOLVE_TRIANGLE_OUT], i,
                      mixed(painted_color(4, 12, 16, 40), eights, share));
        for (uint32_t layer = 0; layer < (all ? RESOLVE_LAYER_COUNT : 1); layer++)
            painted_check(run, outputs[RESOLVE_LAYERS_OUT], layer * FEATURE_TEXELS + i,
                          mixed(painted_color(101 + (float)layer, 4, 0, 0), eights, share));
        painted_check(run, outputs[RESOLVE_KEPT_OUT], i,
                      painted_color(4 * frames * share, 8 * frames * share, 0, 0));
    }
    for (uint32_t i = 0; i < HALF_TEXELS; i++) {
        const float share = coverage(i, FEATURE_SIZE / 2);
        painted_check(run, outputs[RESOLVE_PART_OUT], i,
                      mixed(painted_color(40, 16, 12, 4), eights, share));
        if (all)
            painted_check(run, outputs[RESOLVE_PART_OUT], HALF_TEXELS + i,
                          mixed(painted_color(80, 32, 24, 8), eights, share));
    }
    painted_check_all(run, outputs[RESOLVE_SECOND_OUT], FEATURE_TEXELS, painted_color(4, 3, 2, 1));
    check_integers(run);
    assert_int_equal(store_of(run, RESOLVE_TRIANGLE), VK_ATTACHMENT_STORE_OP_DONT_CARE);
    assert_int_equal(store_of(run, RESOLVE_KEEP), VK_ATTACHMENT_STORE_OP_STORE);
}

static void samples_are_resolved(void **state)
{
    static const struct painted_series series = { FRAMES, begin_resolve, check_resolve };
    const struct gpu *gpu = *state;
    assert_true(gpu->properties.limits.standardSampleLocations);
    painted_series_variants(*state, &feature_resolve.params, &series);
}

/* ---- what is resolved to, where the driver would not show it ---- */

struct part {
    VkImageView view;
    VkImage image;
    uint32_t mip, layer;
    uint32_t uses; /* as what is resolved to, or in a VkFramebuffer */
};

static struct part parts[256];
static uint32_t part_count;
static PFN_vkCreateImageView real_image_view;
static PFN_vkCreateFramebuffer real_framebuffer;
static PFN_vkCmdBeginRendering real_begin_rendering;

static VKAPI_ATTR VkResult VKAPI_CALL see_view(VkDevice device, const VkImageViewCreateInfo *info,
                                               const VkAllocationCallbacks *callbacks,
                                               VkImageView *view)
{
    const VkImageSubresourceRange *range = &info->subresourceRange;
    VkResult result = real_image_view(device, info, callbacks, view);
    assert_true(part_count < sizeof(parts) / sizeof(parts[0]));
    parts[part_count++] =
        (struct part){ *view, info->image, range->baseMipLevel, range->baseArrayLayer, 0 };
    return result;
}

static void see_use(VkImageView view)
{
    for (uint32_t i = 0; i < part_count; i++)
        parts[i].uses += parts[i].view == view;
}

static VKAPI_ATTR VkResult VKAPI_CALL see_framebuffer(VkDevice device,
                                                      const VkFramebufferCreateInfo *info,
                                                      const VkAllocationCallbacks *callbacks,
                                                      VkFramebuffer *framebuffer)
{
    for (uint32_t i = 0; i < info->attachmentCount; i++)
        see_use(info->pAttachments[i]);
    return real_framebuffer(device, info, callbacks, framebuffer);
}

static VKAPI_ATTR void VKAPI_CALL see_rendering(VkCommandBuffer commands,
                                                const VkRenderingInfo *info)
{
    for (uint32_t i = 0; i < info->colorAttachmentCount; i++) {
        if (info->pColorAttachments[i].resolveMode != VK_RESOLVE_MODE_NONE)
            see_use(info->pColorAttachments[i].resolveImageView);
    }
    real_begin_rendering(commands, info);
}

static uint32_t uses_of(VkImage image, uint32_t mip, uint32_t layer)
{
    uint32_t uses = 0;
    for (uint32_t i = 0; i < part_count; i++) {
        if (parts[i].image == image && parts[i].mip == mip && parts[i].layer == layer)
            uses += parts[i].uses;
    }
    return uses;
}

static void check_parts(struct gpu *gpu, const struct run_params *params)
{
    struct rg_frame frame = { .rows = params->technique.passes };
    struct run run;
    part_count = 0;
    real_image_view = vkCreateImageView;
    real_framebuffer = vkCreateFramebuffer;
    real_begin_rendering = vkCmdBeginRendering;
    vkCreateImageView = see_view;
    vkCreateFramebuffer = see_framebuffer;
    vkCmdBeginRendering = see_rendering;
    run_open(&run, gpu, params);
    begin_resolve(&run, 0, &frame);
    run_frame(&run, &frame);
    vkCreateImageView = real_image_view;
    vkCreateFramebuffer = real_framebuffer;
    vkCmdBeginRendering = real_begin_rendering;
    VkImage part = rg_exec_image(run.exec, &feature_resolve_part);
    VkImage layers = rg_exec_image(run.exec, &feature_resolve_layers);
    for (uint32_t layer = 0; layer < 2; layer++) {
        assert_int_equal(uses_of(part, 0, layer), 0);
        assert_int_equal(uses_of(part, 1, layer), 1);
    }
    for (uint32_t layer = 0; layer < RESOLVE_LAYER_COUNT; layer++)
        assert_int_equal(uses_of(layers, 0, layer), 1);
    run_close(&run);
}

static void parts_are_resolved_to(void **state)
{
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params params = run_variant(&feature_resolve.params, way);
        check_parts(*state, &params);
    }
}

/* ---- fetched ---- */

static void begin_samples(struct run *run, uint32_t number, struct rg_frame *frame)
{
    static const struct paint_push paints[SAMPLES_PAINT_COUNT] = {
        [SAMPLES_TRIANGLE] = { .color = { { 1, 2, 3, 4 } }, TRIANGLE, .depth = 0.25F },
    };
    (void)run;
    (void)number;
    frame->paints = paints;
}

static void check_samples(struct run *run, uint32_t number)
{
    const vec4s *depths = run_data(run, run->params.outputs[SAMPLES_DEPTH_OUT]);
    (void)number;
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        vec4s color = { { 0 } };
        float depth = 0;
        for (uint32_t s = 0; s < SAMPLES; s++) {
            const bool covered = is_covered(i, FEATURE_SIZE, s);
            const float weight = (float)(s + 1);
            const vec4s sample = covered ? painted_color(1, 2, 3, 4) : eights;
            color = glms_vec4_add(color, glms_vec4_scale(sample, weight));
            depth += weight * (covered ? 0.25F : 0.5F);
        }
        painted_check(run, run->params.outputs[SAMPLES_COLOR_OUT], i, color);
        CHECK_NEAR(depths[i].x, depth, 0);
    }
}

static void samples_are_fetched(void **state)
{
    static const struct painted_series series = { FRAMES, begin_samples, check_samples };
    painted_series_variants(*state, &feature_samples.params, &series);
}

/* ---- how many there may be ---- */

static void device_says_how_many(void **state)
{
    const struct gpu *gpu = *state;
    const struct rg_vulkan vulkan = { gpu->instance, vkGetInstanceProcAddr, gpu->physical,
                                      gpu->device };
    const struct rg_device device = rg_exec_device(&vulkan);
    struct rg_plan_image image = {
        .image = &feature_resolve_part,
        .extent = { 8, 8 },
        .layers = 6,
        .mips = 1,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
        .samples = 1,
    };
    VkImageCreateInfo info = rg_image_create_info(&image);
    assert_int_equal(device.sample_counts(device.user, &info) & 5,
                     VK_SAMPLE_COUNT_1_BIT | VK_SAMPLE_COUNT_4_BIT);
    info.flags = VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
    assert_int_equal(device.sample_counts(device.user, &info), VK_SAMPLE_COUNT_1_BIT);
    info.flags = 0;
    info.format = VK_FORMAT_E5B9G9R9_UFLOAT_PACK32; /* no colour target anywhere */
    assert_int_equal(device.sample_counts(device.user, &info), 0);
}

/* 64 are more than this driver has. */
static void plan_asks_the_device(void **state)
{
    static const struct rg_image many = COLOR_IMAGE("many", .samples = 64);
    const struct rg_pass rows[] = {
        { .name = "paint", .color = RG_TARGETS({ &many, RG_LOAD_CLEAR }), PAINTED },
    };
    const struct rg_technique technique = RG_TECHNIQUE("test", rows);
    const struct rg_technique *const techniques[] = { &technique };
    const struct rg_output output = { .image = &many, .access = RG_SAMPLED };
    const struct gpu *gpu = *state;
    const struct rg_vulkan vulkan = { gpu->instance, vkGetInstanceProcAddr, gpu->physical,
                                      gpu->device };
    const struct rg_device device = rg_exec_device(&vulkan);
    struct rg_compile_params params = {
        .techniques = techniques,
        .technique_count = 1,
        .view = { 8, 8 },
        .outputs = &output,
        .output_count = 1,
        .device = &device,
    };
    struct rg_plan *plan = rg_compile(&params);
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 1);
    assert_int_equal(plan->faults[0].error, RG_ERROR_SAMPLES);
    rg_plan_destroy(plan);
    params.device = NULL;
    plan = rg_compile(&params);
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    rg_plan_destroy(plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(samples_are_resolved), ON_DEVICE(parts_are_resolved_to),
        ON_DEVICE(samples_are_fetched),  ON_DEVICE(device_says_how_many),
        ON_DEVICE(plan_asks_the_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
