/* Faults of samples, resolves, history and conditions. */
#include <math.h>

#include "graph/rg.h"
#include "tests/support/assertions.h"
#include "tests/support/fault_case.h"

#define COLOR_FORMAT VK_FORMAT_R8G8B8A8_UNORM

#define PICTURE fault_case_picture
#define OTHER   fault_case_other

static const struct rg_image four = { "four", COLOR_FORMAT, .samples = 4 };
static const struct rg_image three = { "three", COLOR_FORMAT, .samples = 3 };
static const struct rg_image chained = { "chained", COLOR_FORMAT, .samples = 4, .mips = 2 };
static const struct rg_image deep = { "deep", VK_FORMAT_D32_SFLOAT, .samples = 4 };
static const struct rg_image flat = { "flat", VK_FORMAT_D32_SFLOAT };
static const struct rg_image floats = { "floats", VK_FORMAT_R32_SFLOAT };
static const struct rg_image half = { "half", COLOR_FORMAT, .scale = 0.5f };
static const struct rg_buffer upload = {
    .name = "upload",
    .size = 64,
    .memory = RG_MEMORY_UPLOAD,
    .persistent = true,
};
static const struct rg_buffer given = { .name = "given", .size = 64, .memory = RG_MEMORY_UPLOAD };
static const struct rg_image last = { "last", COLOR_FORMAT, .previous = &OTHER };
static const struct rg_image last_half = { "last_half", COLOR_FORMAT, .scale = 0.5f,
                                           .previous = &OTHER };
static const struct rg_image last_last = { "last_last", COLOR_FORMAT, .previous = &last };
static const struct rg_image own_last = { "own_last", COLOR_FORMAT, .previous = &own_last };
static const struct rg_sampler nearest = { 0 };

static VkSampleCountFlags one_sample(const void *user, const VkImageCreateInfo *info)
{
    (void)user;
    (void)info;
    return VK_SAMPLE_COUNT_1_BIT;
}

static const struct rg_device plain_device = { .sample_counts = one_sample };

#define RESOLVE(from, to) \
    DRAW("draw", .color = RG_TARGETS({ .image = &(from), .load = RG_LOAD_CLEAR, .resolve = &(to) }))

static const struct fault_case sample_cases[] = {
    { AROUND(RG_ERROR_SAMPLES, "three", FILL(three)) },
    { AROUND(RG_ERROR_SAMPLES, "chained", FILL(chained)) },
    { ROW(RG_ERROR_SAMPLES, "deep",
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }), .depth = { CLEARED(deep) })) },
    { ROW(RG_ERROR_SAMPLES, "other",
          DRAW("draw", .color = RG_TARGETS({ CLEARED(four) }, { CLEARED(OTHER) }))) },
    { ROW(RG_ERROR_SAMPLES, "picture", RESOLVE(OTHER, PICTURE)) },
    { ROW(RG_ERROR_SAMPLES, "deep",
          DRAW("draw", .depth = { .image = &deep, .load = RG_LOAD_CLEAR, .resolve = &flat })) },
    { ROW(RG_ERROR_SAMPLES, "four", COPY("copy", { &four, .access = RG_COPY_DST })) },
    { .error = RG_ERROR_SAMPLES,
      .resource = "four",
      .row = true,
      .row_count = 2,
      .rows = { FILL(four), ALSO(&four, .access = RG_SAMPLED, .sampler = &nearest) } },
    { ROW(RG_ERROR_FORMAT, "floats", RESOLVE(four, floats)) },
    { ROW(RG_ERROR_TARGET_SIZE, "half", RESOLVE(four, half)) },
    { .error = RG_ERROR_SAMPLES,
      .resource = "four",
      .row_count = 1,
      .rows = { RESOLVE(four, PICTURE) },
      .device = &plain_device },
};

static const struct fault_case view_cases[] = {
    { ROW(RG_ERROR_FORMAT, "picture",
          ALSO(&PICTURE, .access = RG_SAMPLED, .view_format = VK_FORMAT_R16_SFLOAT)) },
    { ROW(RG_ERROR_FORMAT, "picture",
          ALSO(&PICTURE, .access = RG_SAMPLED, .view_format = VK_FORMAT_D32_SFLOAT)) },
    { ROW(RG_ERROR_FORMAT, "given",
          ALSO(.buffer = &given, .access = RG_UNIFORM, .view_format = VK_FORMAT_R32_UINT)) },
    { ROW(RG_ERROR_FORMAT, "picture",
          COPY("copy", { &OTHER, .access = RG_COPY_DST },
               { &PICTURE, .access = RG_COPY_SRC, .view_format = VK_FORMAT_R32_UINT })) },
};

static const struct fault_case history_cases[] = {
    { AROUND(RG_ERROR_PERSISTENT, "upload", ALSO(.buffer = &upload, .access = RG_UNIFORM)) },
    { AROUND(RG_ERROR_PERSISTENT, "last_half", ALSO(&last_half, .access = RG_SAMPLED)) },
    { AROUND(RG_ERROR_PERSISTENT, "last_last", ALSO(&last_last, .access = RG_SAMPLED)) },
    { AROUND(RG_ERROR_PERSISTENT, "own_last", ALSO(&own_last, .access = RG_SAMPLED)) },
    { .error = RG_ERROR_PERSISTENT,
      .resource = "last",
      .row_count = 1,
      .rows = { ALSO(&last, .access = RG_SAMPLED) },
      .imports = { { .image = &OTHER, .access = RG_SAMPLED } } },
    { .error = RG_ERROR_ACCESS,
      .resource = "last",
      .row = true,
      .row_count = 2,
      .rows = { DRAW("other", .color = RG_TARGETS({ CLEARED(OTHER) })), FILL(last) } },
    { AROUND(RG_ERROR_OUTPUT_NOT_WRITTEN, "other",
             DRAW("draw", .color = RG_TARGETS({ &PICTURE }), SAMPLING(last))) },
};

static bool sometimes(const struct rg_frame *frame, uint32_t repetition)
{
    (void)frame;
    (void)repetition;
    return false;
}

static bool rarely(const struct rg_frame *frame, uint32_t repetition)
{
    (void)frame;
    (void)repetition;
    return false;
}

#define MAYBE DRAW("maybe", .color = RG_TARGETS({ CLEARED(OTHER) }), .when = sometimes)

static const struct fault_case condition_cases[] = {
    { .error = RG_ERROR_READ_BEFORE_WRITE, /* if the first does not run */
      .resource = "other",
      .row = true,
      .row_count = 2,
      .rows = { MAYBE, DRAW("draw", .color = RG_TARGETS({ &PICTURE }), SAMPLING(OTHER)) } },
    { .error = RG_ERROR_READ_BEFORE_WRITE,
      .resource = "other",
      .row = true,
      .row_count = 2,
      .rows = { MAYBE, DRAW("draw", .color = RG_TARGETS({ &PICTURE }), SAMPLING(OTHER),
                            .when = rarely) } },
    { .error = RG_ERROR_OUTPUT_NOT_WRITTEN,
      .resource = "other",
      .row_count = 1,
      .rows = { MAYBE },
      .outputs = { { .image = &OTHER, .access = RG_SAMPLED } } },
};

/* Stages that the pass has no shader for. */
static const struct fault_case stage_cases[] = {
    { ROW(RG_ERROR_ACCESS, "picture",
          ALSO(&PICTURE, .access = RG_SAMPLED, .stages = VK_SHADER_STAGE_FRAGMENT_BIT)) },
    { ROW(RG_ERROR_ACCESS, "picture",
          COPY("copy", { &OTHER, .access = RG_COPY_DST },
               { &PICTURE, .access = RG_COPY_SRC, .stages = VK_SHADER_STAGE_COMPUTE_BIT })) },
    { ROW(RG_ERROR_ACCESS, "picture",
          ALSO(&PICTURE, .access = RG_SAMPLED, .stages = VK_SHADER_STAGE_GEOMETRY_BIT)) },
};

/* ---- samplers ---- */

static const struct rg_sampler wrong_samplers[] = {
    { .lod_bias = INFINITY },
    { .min_lod = 2, .max_lod = 1 },
    { .compare = (VkCompareOp)(VK_COMPARE_OP_ALWAYS + 1) },
    { .border_color = (VkBorderColor)(VK_BORDER_COLOR_INT_OPAQUE_WHITE + 1) },
    { .border = true, .border_color = VK_BORDER_COLOR_INT_OPAQUE_BLACK }, /* float format */
    { .compare = VK_COMPARE_OP_LESS },                                    /* colour */
};

#define SAMPLES_BY(number) \
    { \
        ROW(RG_ERROR_VALUE, "picture", \
            ALSO(&PICTURE, .access = RG_SAMPLED, .sampler = &wrong_samplers[number])) \
    }
static const struct fault_case sampler_cases[] = {
    SAMPLES_BY(0), SAMPLES_BY(1), SAMPLES_BY(2), SAMPLES_BY(3), SAMPLES_BY(4), SAMPLES_BY(5),
};

/* ---- other resources ---- */

static const struct rg_image volume = { "volume", COLOR_FORMAT, .depth = 4 };
static const struct rg_image stacked = { "stacked", COLOR_FORMAT, .depth = 4, .layers = 2 };
static const struct rg_image many = { "many", COLOR_FORMAT, .layers = 7 };
static const struct rg_image dark = { "dark", VK_FORMAT_D32_SFLOAT, .depth = 4 };
static const struct rg_image huge = { "huge", COLOR_FORMAT, .depth = 1 << 15 };
static const struct rg_image short_chain = { "short chain", COLOR_FORMAT, 4, 4,
                                             .mips = 5,     .depth = 8 };
static const struct rg_buffer plain = { "plain", 64 };
static const struct rg_buffer texels = { "texels", 64, .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer up = { "up", 64, .memory = RG_MEMORY_UPLOAD,
                                     .format = VK_FORMAT_R32_UINT };
static const struct rg_set nameless = { NULL };
static const struct rg_set own = { "own" };

static VkFormatFeatureFlags no_features(const void *user, VkFormat format)
{
    (void)user;
    (void)format;
    return 0;
}

static const struct rg_device no_texels = { .buffer_features = no_features };

#define TEXELS(of, kind) \
    { \
        .buffer = &(of), .access = (kind), .texels = true, .binding = 1 \
    }
#define ELEMENT(of, number, at) \
    { \
        .image = &(of), .access = RG_SAMPLED, .binding = (at), .element = (number) \
    }

static const struct fault_case resource_cases[] = {
    { ROW(RG_ERROR_ACCESS, "volume", FILL(volume)) },
    { AROUND(RG_ERROR_VALUE, "stacked",
             COMPUTE("compute", { &stacked, .access = RG_STORAGE_WRITE })) },
    { AROUND(RG_ERROR_VALUE, "dark", COPY("copy", { &dark, .access = RG_COPY_DST })) },
    { AROUND(RG_ERROR_TOO_LARGE, "huge",
             COMPUTE("compute", { &huge, .access = RG_STORAGE_WRITE })) },
    { AROUND(RG_ERROR_RANGE, "short chain",
             COMPUTE("compute", { &short_chain, .access = RG_STORAGE_WRITE })) },
    { IMPORT(RG_ERROR_ACCESS, "volume", { .image = &volume, .access = RG_COLOR }) },
    { ROW(RG_ERROR_ACCESS, "plain", COMPUTE("compute", TEXELS(plain, RG_STORAGE_WRITE))) },
    { ROW(RG_ERROR_ACCESS, "up", COMPUTE("compute", { WRITE_OTHER }, TEXELS(up, RG_UNIFORM))) },
    { ROW(RG_ERROR_FORMAT, "texels",
          COMPUTE("compute", { &PICTURE, .access = RG_STORAGE_READ_WRITE },
                  TEXELS(texels, RG_STORAGE_WRITE))),
      .device = &no_texels },
    { ROW(RG_ERROR_VALUE, "picture", COMPUTE("compute", ELEMENT(PICTURE, 1, 0), { WRITE_OTHER })) },
    { ROW(RG_ERROR_VALUE, "picture",
          COMPUTE("compute", ELEMENT(PICTURE, 0, 0), ELEMENT(PICTURE, 2, 0), { WRITE_OTHER })) },
    { ROW(RG_ERROR_VALUE, "picture",
          COMPUTE("compute", ELEMENT(PICTURE, 0, 0), ELEMENT(PICTURE, 1, 1), { WRITE_OTHER })) },
    { ROW(RG_ERROR_VALUE, "other",
          COMPUTE("compute", ELEMENT(PICTURE, 0, 0),
                  { &OTHER, .access = RG_STORAGE_WRITE, .element = 1 })) },
    { ROW(RG_ERROR_DUPLICATE_BINDING, "picture",
          COMPUTE("compute", ELEMENT(PICTURE, 0, 0), ELEMENT(PICTURE, 1, 0), { WRITE_OTHER },
                  ELEMENT(PICTURE, 0, 0))) },
    { ROW(RG_ERROR_NO_NAME, NULL,
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }), .set = &nameless)) },
    { ROW(RG_ERROR_RANGE, "other",
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }), .layers = 2)) },
    { ROW(RG_ERROR_RANGE, "other",
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }), .layers = 2, .multiview = true)) },
    { ROW(RG_ERROR_VALUE, NULL,
          DRAW("draw", .color = RG_TARGETS({ CLEARED(many) }), .uses = RG_USES({ WRITE_OTHER }),
               .layers = 7, .multiview = true)) },
    { ROW(RG_ERROR_VALUE, NULL,
          { .name = "compute",
            .kind = RG_COMPUTE,
            .comp = &small_graph_shader,
            .record = small_graph_record,
            .uses = RG_USES({ WRITE_OTHER }),
            .multiview = true }) },
    { ROW(RG_ERROR_ACCESS, "own",
          { .name = "copy",
            .kind = RG_TRANSFER,
            .record = small_graph_record,
            .set = &own,
            .uses = RG_USES({ &OTHER, .access = RG_COPY_DST }) }) },
};

/* ---- acceleration structures ---- */

static const struct rg_buffer tree = { "tree", 256 };

static const struct fault_case structure_cases[] = {
    { .error = RG_ERROR_ACCESS,
      .resource = "tree",
      .row = true,
      .row_count = 2,
      .rows = { COPY("write", { .buffer = &tree, .access = RG_COPY_DST }),
                COPY("bad", { &OTHER, .access = RG_COPY_DST },
                     { .buffer = &tree, .access = RG_TRACE }) },
      .outputs = { { .image = &fault_case_other, .access = RG_COPY_SRC } } },
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "tree", ALSO(.buffer = &tree, .access = RG_TRACE)) },
    { .error = RG_ERROR_ACCESS,
      .resource = "tree",
      .row_count = 2,
      .rows = { COPY("write", { .buffer = &tree, .access = RG_COPY_DST }),
                ALSO(.buffer = &tree, .access = RG_TRACE) },
      .outputs = { { .image = &fault_case_other, .access = RG_SAMPLED } } },
};

/* What is near a fault and none. */
static const struct rg_pass good_arrays[] = {
    COMPUTE("array", ELEMENT(PICTURE, 0, 3), ELEMENT(PICTURE, 1, 3), ELEMENT(PICTURE, 2, 3),
            { WRITE_OTHER }, ELEMENT(PICTURE, 0, 2), ELEMENT(PICTURE, 1, 2),
            TEXELS(texels, RG_STORAGE_WRITE)),
    COMPUTE("volume", { &volume, .access = RG_STORAGE_WRITE },
            TEXELS(texels, RG_STORAGE_READ_WRITE)),
};

static void test_good_resources(void **state)
{
    (void)state;
    const struct fault_case fc = {
        .row_count = 2,
        .rows = { good_arrays[0], good_arrays[1] },
        .outputs = { { .image = &fault_case_other, .access = RG_SAMPLED },
                     { .image = &volume, .access = RG_SAMPLED } },
    };
    struct rg_plan *plan = fault_case_compile(&fc);
    assert_non_null(plan);
    if (plan->fault_count)
        rg_dump(plan, stderr);
    assert_int_equal(plan->fault_count, 0);
    rg_plan_destroy(plan);
}

static void test_every_case(void **state)
{
    (void)state;
    const struct fault_cases tables[] = {
        FAULT_CASES(sample_cases),    FAULT_CASES(view_cases),      FAULT_CASES(history_cases),
        FAULT_CASES(condition_cases), FAULT_CASES(stage_cases),     FAULT_CASES(sampler_cases),
        FAULT_CASES(resource_cases),  FAULT_CASES(structure_cases),
    };
    bool provoked[RG_ERROR_COUNT] = { false };
    fault_case_check(tables, sizeof(tables) / sizeof(tables[0]), provoked);
    for (int error = RG_ERROR_SAMPLES; error < RG_ERROR_VALUE; error++)
        assert_true(provoked[error]);
}

/* What a condition filled is there for others of the same condition. */
static void test_one_condition(void **state)
{
    (void)state;
    const struct fault_case fc = {
        .row_count = 2,
        .rows = { MAYBE, DRAW("draw", .color = RG_TARGETS({ &PICTURE }), SAMPLING(OTHER),
                              .when = sometimes) },
    };
    struct rg_plan *plan = fault_case_compile(&fc);
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(plan->pass_count, 3);
    rg_plan_destroy(plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_case),
        cmocka_unit_test(test_one_condition),
        cmocka_unit_test(test_good_resources),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
