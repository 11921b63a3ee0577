/* test_exec_sampler.c: samplers as their descriptions say. */
#include <math.h>

#include "tests/support/assertions.h"

#include "tests/gpu/shaders/data.h"
#include "tests/support/all_features_device.h"
#include "tests/support/lavapipe.h"
#include "tests/support/rectangle_rows.h"

enum {
    SAMPLED_COUNT = 8,
    MIP_1 = 4 * 2, /* texels before it in the upload buffer */
};

static const struct rg_image sampled = COLOR_IMAGE("sampled", .width = 4, .height = 2, .mips = 2);

static const struct rg_buffer sampled_in = {
    .name = "sampled in",
    .size = (MIP_1 + 2) * sizeof(vec4s),
    .memory = RG_MEMORY_UPLOAD,
};
static const struct rg_buffer sampled_out = {
    .name = "sampled out",
    .size = SAMPLED_COUNT * sizeof(vec4s),
    .memory = RG_MEMORY_READBACK,
};

/* no device has the last one's anisotropy */
static const struct rg_sampler samplers[] = {
    { .repeat_u = true },
    { .repeat_v = true },
    { .linear = true },
    { .mips = true },
    { .linear = true, .mips = true },
    { .linear = true, .mips = true, .anisotropy = 1000 },
};

static void record_mip_0(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_buffer_to_image(cmd, &sampled_in, 0, &sampled);
}

static void record_mip_1(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_buffer_to_image(cmd, &sampled_in, MIP_1 * sizeof(vec4s), &sampled);
}

static void record_once(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, 1, 1, 1);
}

#define FILL_MIP(title, number, record_function) \
    { \
        .name = (title), .kind = RG_TRANSFER, \
        .uses = RG_USES({ .buffer = &sampled_in, .access = RG_COPY_SRC }, \
                        { .image = &sampled, \
                          .access = RG_COPY_DST, \
                          .range = { .mip = (number), .mip_count = 1 } }), \
        .record = (record_function), \
    }
#define THROUGH(number, description) \
    { \
        .image = &sampled, .access = RG_SAMPLED, .binding = DATA_SAMPLERS + (number), \
        .sampler = (description), \
    }

static const struct rg_pass sampler_rows[] = {
    FILL_MIP("mip 0", 0, record_mip_0),
    FILL_MIP("mip 1", 1, record_mip_1),
    {
        .name = "sample",
        .kind = RG_COMPUTE,
        .uses =
            RG_USES(THROUGH(0, NULL), THROUGH(1, &samplers[0]), THROUGH(2, &samplers[1]),
                    THROUGH(3, &samplers[2]), THROUGH(4, &samplers[3]), THROUGH(5, &samplers[4]),
                    THROUGH(6, &samplers[5]),
                    { .buffer = &sampled_out, .access = RG_STORAGE_WRITE, .binding = DATA_COLORS }),
        .comp = &samplers_comp,
        .record = record_once,
    },
};

/* Texel (x, y) holds x + 10 y, of mip 1 100 + x. */
static void samplers_are_as_described(void **state)
{
    static const double wanted[SAMPLED_COUNT - 1] = {
        3 + 10, 1 + 10, 3, 1.5, 1, 100, (1 + 100.25) / 2,
    };
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", sampler_rows),
        .outputs = { &sampled_out },
    };
    struct run run;
    run_open(&run, *state, &params);
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    vec4s *texels = run_data(&run, &sampled_in);
    for (int i = 0; i < 4; i++) {
        texels[i] = painted_color((float)i, 0, 0, 0);
        texels[4 + i] = painted_color((float)(i + 10), 0, 0, 0);
    }
    for (int i = 0; i < 2; i++)
        texels[MIP_1 + i] = painted_color((float)(100 + i), 0, 0, 0);
    assert_int_equal(rg_exec_submit(run.exec, NULL), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
    const vec4s *colors = run_data(&run, &sampled_out);
    for (int i = 0; i < SAMPLED_COUNT - 1; i++)
        CHECK_NEAR(colors[i].x, wanted[i], 1e-3);
    /* drivers differ in what they make of anisotropy without derivatives */
    assert_true(colors[SAMPLED_COUNT - 1].x >= 1 && colors[SAMPLED_COUNT - 1].x <= 100.25F);
    run_close(&run);
}

/* ---- comparison, border, mirror, levels, reduction, the program's own ---- */

static const struct rg_image depths = {
    .name = "depths", .format = VK_FORMAT_D32_SFLOAT, .width = 4, .height = 1
};
static const struct rg_image heights = {
    .name = "heights", .format = VK_FORMAT_R32_SFLOAT, .width = 4, .height = 1
};
static const struct rg_buffer depths_in = { .name = "depths in",
                                            .size = 4 * sizeof(float),
                                            .memory = RG_MEMORY_UPLOAD };
static const struct rg_sampler shadow = { .linear = true, .compare = VK_COMPARE_OP_LESS };
static const struct rg_sampler own = { .linear = true };
static const struct rg_sampler further[] = {
    { .repeat_u = true, .mirror = true },
    { .border = true, .border_color = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE },
    { .mips = true, .lod_bias = 1 },
    { .mips = true, .min_lod = 1 },
    { .mips = true, .max_lod = 0.25F },
    { .linear = true, .reduction = VK_SAMPLER_REDUCTION_MODE_MAX },
};

static void record_depths(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_copy_buffer_to_image(cmd, &depths_in, 0, &depths);
    rg_cmd_copy_buffer_to_image(cmd, &depths_in, 0, &heights);
}

static const struct rg_pass further_rows[] = {
    FILL_MIP("mip 0", 0, record_mip_0),
    FILL_MIP("mip 1", 1, record_mip_1),
    {
        .name = "depths",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .buffer = &depths_in, .access = RG_COPY_SRC },
                        { .image = &depths, .access = RG_COPY_DST },
                        { .image = &heights, .access = RG_COPY_DST }),
        .record = record_depths,
    },
    {
        .name = "sample",
        .kind = RG_COMPUTE,
        .uses =
            RG_USES({ .image = &depths,
                      .access = RG_SAMPLED,
                      .binding = DATA_SAMPLERS,
                      .sampler = &shadow },
                    THROUGH(1, &further[0]), THROUGH(2, &further[1]), THROUGH(3, &further[2]),
                    THROUGH(4, &further[3]), THROUGH(5, &further[4]),
                    { .image = &heights,
                      .access = RG_SAMPLED,
                      .binding = DATA_SAMPLERS + 6,
                      .sampler = &further[5] },
                    THROUGH(7, &own),
                    { .buffer = &sampled_out, .access = RG_STORAGE_WRITE, .binding = DATA_COLORS }),
        .comp = &shadow_samplers_comp,
        .record = record_once,
    },
};

static void samplers_compare_and_reduce(void **state)
{
    static const double wanted[SAMPLED_COUNT] = { .5, 2, 1, 100, 100, 1, .6, 1 };
    const VkSamplerCreateInfo info = { .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                       .addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT };
    struct rg_exec_sampler handle = { .sampler = &own };
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", further_rows),
        .outputs = { &sampled_out },
        .own_sampler = &handle,
    };
    struct run run;
    struct gpu gpu;
    all_features_device_open(&gpu, *state);
    assert_int_equal(vkCreateSampler(gpu.device, &info, NULL, &handle.handle), VK_SUCCESS);
    run_open(&run, &gpu, &params);
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    vec4s *texels = run_data(&run, &sampled_in);
    float *depth = run_data(&run, &depths_in);
    for (int i = 0; i < MIP_1 + 2; i++)
        texels[i] = painted_color((float)(i < MIP_1 ? i : 92 + i), 0, 0, 0);
    for (int i = 0; i < 4; i++)
        depth[i] = 0.2F + 0.2F * (float)i;
    assert_int_equal(rg_exec_submit(run.exec, NULL), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
    const vec4s *colors = run_data(&run, &sampled_out);
    for (int i = 0; i < SAMPLED_COUNT; i++)
        CHECK_NEAR(colors[i].x, wanted[i], 1e-3);
    run_close(&run);
    vkDestroySampler(gpu.device, handle.handle, NULL);
    all_features_device_close(&gpu);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(samplers_are_as_described),
        ON_DEVICE(samplers_compare_and_reduce),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
