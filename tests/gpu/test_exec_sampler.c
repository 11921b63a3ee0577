/* test_exec_sampler.c: samplers as their descriptions say. */
#include <math.h>

#include "tests/support/assertions.h"

#include "tests/gpu/shaders/data.h"
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(samplers_are_as_described),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
