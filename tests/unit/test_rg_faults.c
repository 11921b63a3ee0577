/* Every fault the compiler of plans can find: one small table for each way to provoke it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/rg.h"
#include "tests/support/assertions.h"
#include "tests/support/fault_case.h"

#define COLOR_FORMAT VK_FORMAT_R8G8B8A8_UNORM
#define WILD         FAULT_CASE_WILD

/* ---- resources, good ones first ---- */

#define PICTURE fault_case_picture
#define OTHER   fault_case_other

static const struct rg_image third = { .name = "third", .format = COLOR_FORMAT };
static const struct rg_image small = { .name = "small", .format = COLOR_FORMAT, .scale = 0.5f };
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_image stencil = { .name = "stencil", .format = VK_FORMAT_D24_UNORM_S8_UINT };
static const struct rg_image chain = { .name = "chain", .format = COLOR_FORMAT, .mips = 3 };
static const struct rg_image pages = { .name = "pages", .format = COLOR_FORMAT, .layers = 4 };
static const struct rg_image few = { .name = "few", .format = COLOR_FORMAT, .layers = 2 };
static const struct rg_buffer bytes = { .name = "bytes", .size = 64 };
static const struct rg_buffer upload = { "upload", 64, 0, RG_MEMORY_UPLOAD };
static const struct rg_buffer texels = { "texels", 64, 0, RG_MEMORY_UPLOAD,
                                         .format = VK_FORMAT_R32_UINT };

static const struct rg_image nameless = { .format = COLOR_FORMAT };
static const struct rg_image twin = { .name = "other", .format = COLOR_FORMAT };
static const struct rg_image formatless = { .name = "formatless" };
static const struct rg_image wide = { .name = "wide", .format = COLOR_FORMAT, .width = 65537 };
static const struct rg_image thick = { .name = "thick", .format = COLOR_FORMAT, .layers = WILD };
static const struct rg_image endless = { "endless", COLOR_FORMAT, .scale = INFINITY };
static const struct rg_image negative = { "negative", COLOR_FORMAT, .scale = -1.0f };
static const struct rg_image unscaled = { "unscaled", COLOR_FORMAT, .scale = NAN };
static const struct rg_image oblong = { "oblong", COLOR_FORMAT, 64, 32, .cube = true };
static const struct rg_image five = { "five", COLOR_FORMAT, 64, 64, .layers = 5, .cube = true };
static const struct rg_image deep = { "deep", COLOR_FORMAT, 64, 64, .mips = 8 };
static const struct rg_image abyss = { "abyss", COLOR_FORMAT, 64, 64, .mips = 33 };
static const struct rg_buffer empty = { .name = "empty" };
static const struct rg_buffer vast = { "vast", .size_per_texel = UINT64_MAX / 2 };
static const struct rg_buffer huge = { .name = "huge", .size = UINT64_MAX / 2 };
static const struct rg_buffer brim = { "brim", .size = UINT64_MAX, .size_per_texel = 4 };

/* ---- devices made by hand ---- */

static VkFormatFeatureFlags only_sampled(const void *user, VkFormat format)
{
    (void)user;
    (void)format;
    return VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
}

static VkFormatFeatureFlags all_but_some(const void *user, VkFormat format)
{
    (void)user;
    return format == COLOR_FORMAT
               ? ~(VkFormatFeatureFlags)(VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT |
                                         VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT)
               : 0;
}

static const struct rg_device sampling_device = { .format_features = only_sampled };
static const struct rg_device plain_device = { .format_features = all_but_some };
static const struct rg_device small_device = { .max_image_size = FAULT_CASE_VIEW - 1 };
static const struct rg_device thin_device = { .max_layers = 3 };

static const struct rg_sampler linear = { .linear = true };

/* ---- cases ---- */

static const struct fault_case params_cases[] = {
    { .error = RG_ERROR_NO_OUTPUT, .no_output = true },
    { .error = RG_ERROR_NO_SIZE, .no_view = true },
    { .error = RG_ERROR_NO_NAME, .nameless_technique = true },
    { OUTPUT(RG_ERROR_OUTPUT_NOT_WRITTEN, "other", { .image = &OTHER, .access = RG_SAMPLED }) },
    { OUTPUT(RG_ERROR_OUTPUT_NOT_WRITTEN, "bytes", { .buffer = &bytes, .access = RG_COPY_SRC }) },
    { OUTPUT(RG_ERROR_LISTED_TWICE, "picture", { .image = &PICTURE, .access = RG_SAMPLED },
             { .image = &PICTURE, .access = RG_COPY_SRC }) },
    { OUTPUT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .image = &PICTURE, .buffer = &bytes }) },
    { OUTPUT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .access = RG_SAMPLED }) },
    { OUTPUT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .image = &PICTURE }) },
    { OUTPUT(RG_ERROR_ACCESS, "picture", { .image = &PICTURE, .access = RG_UNIFORM }) },
    { OUTPUT(RG_ERROR_ACCESS, "picture", { .image = &PICTURE, .access = RG_DEPTH_READ }) },
    { OUTPUT(RG_ERROR_ACCESS, "picture", { .image = &PICTURE, .access = RG_PRESENT }) },
    { OUTPUT(RG_ERROR_ACCESS, "picture", { .image = &PICTURE, .access = RG_HOST_READ }) },
    { IMPORT(RG_ERROR_LISTED_TWICE, "other", { .image = &OTHER, .access = RG_SAMPLED },
             { .image = &OTHER }) },
    { IMPORT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .image = &OTHER, .buffer = &bytes }) },
    { IMPORT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .access = RG_SAMPLED }) },
    { IMPORT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .image = &OTHER, .access = RG_ACCESS_COUNT }) },
    { IMPORT(RG_ERROR_ACCESS, "other", { .image = &OTHER, .access = RG_HOST_READ }) },
    { IMPORT(RG_ERROR_ACCESS, "other", { .image = &OTHER, .access = RG_VERTEX }) },
    { IMPORT(RG_ERROR_ACCESS, "depth", { .image = &depth, .access = RG_COLOR }) },
    { IMPORT(RG_ERROR_ACCESS, "bytes", { .buffer = &bytes, .access = RG_PRESENT }) },
    { IMPORT(RG_ERROR_RANGE, "other", { .image = &OTHER, .access = RG_SAMPLED, .mips = WILD }) },
    { IMPORT(RG_ERROR_TOO_LARGE, "other", { .image = &OTHER, .extent = { WILD, WILD } }) },
    { IMPORT(RG_ERROR_TOO_LARGE, "bytes", { .buffer = &bytes, .size = UINT64_MAX }) },
};

static const struct fault_case resource_cases[] = {
    { AROUND(RG_ERROR_NO_NAME, "?", FILL(nameless)) },
    { AROUND(RG_ERROR_DUPLICATE_NAME, "other",
             DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }, { CLEARED(twin) }))) },
    { AROUND(RG_ERROR_FORMAT, "formatless", FILL(formatless)) },
    { AROUND(RG_ERROR_TOO_LARGE, "wide", FILL(wide)) },
    { AROUND(RG_ERROR_TOO_LARGE, "thick", FILL(thick)) },
    { AROUND(RG_ERROR_TOO_LARGE, "endless", FILL(endless)) },
    { AROUND(RG_ERROR_TOO_LARGE, "vast", COPY_TO(vast)) },
    { AROUND(RG_ERROR_TOO_LARGE, "huge", COPY_TO(huge)) },
    { AROUND(RG_ERROR_TOO_LARGE, "brim", COPY_TO(brim)) },
    { AROUND(RG_ERROR_NO_SIZE, "negative", FILL(negative)) },
    { AROUND(RG_ERROR_NO_SIZE, "unscaled", FILL(unscaled)) },
    { AROUND(RG_ERROR_NO_SIZE, "empty", COPY_TO(empty)) },
    { AROUND(RG_ERROR_CUBE, "oblong", FILL(oblong)) },
    { AROUND(RG_ERROR_CUBE, "five", FILL(five)) },
    { AROUND(RG_ERROR_RANGE, "deep", FILL(deep)) },
    { AROUND(RG_ERROR_RANGE, "abyss", FILL(abyss)) },
    /* the CPU cannot read what is not in its memory */
    { AROUND(RG_ERROR_ACCESS, "bytes", COPY_TO(bytes)),
      .outputs = { { .buffer = &bytes, .access = RG_HOST_READ } } },
    { .error = RG_ERROR_TOO_LARGE, .resource = "picture", .device = &small_device },
    { AROUND(RG_ERROR_TOO_LARGE, "pages", FILL(pages)), .device = &thin_device },
};

static const struct fault_case row_cases[] = {
    { ROW(RG_ERROR_NO_NAME, NULL, DRAW(NULL, .color = RG_TARGETS({ CLEARED(OTHER) }))) },
    { ROW(RG_ERROR_DUPLICATE_NAME, NULL, DRAW("fill", .color = RG_TARGETS({ CLEARED(OTHER) }))) },
    { ROW(RG_ERROR_NO_RECORD, NULL,
          { .name = "draw",
            .vert = &small_graph_shader,
            .frag = &small_graph_shader,
            .color = RG_TARGETS({ CLEARED(OTHER) }) }) },
    { ROW(RG_ERROR_NO_SHADER, NULL,
          { .name = "draw",
            .frag = &small_graph_shader,
            .record = small_graph_record,
            .color = RG_TARGETS({ CLEARED(OTHER) }) }) },
    { ROW(RG_ERROR_NO_SHADER, NULL,
          { .name = "draw",
            .vert = &small_graph_shader,
            .record = small_graph_record,
            .color = RG_TARGETS({ CLEARED(OTHER) }) }) },
    { ROW(RG_ERROR_NO_SHADER, NULL,
          { "compute", RG_COMPUTE, .vert = &small_graph_shader, .record = small_graph_record,
            .uses = RG_USES({ WRITE_OTHER }) }) },
    { ROW(RG_ERROR_NO_SHADER, NULL,
          { .name = "draw", /* without .kind */
            .comp = &small_graph_shader,
            .record = small_graph_record,
            .color = RG_TARGETS({ CLEARED(OTHER) }) }) },
    { ROW(RG_ERROR_PUSH_SIZE, NULL,
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }), .push_size = 132)) },
    { ROW(RG_ERROR_PUSH_SIZE, NULL,
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }), .push_size = 6)) },
    { ROW(RG_ERROR_NO_TARGET, NULL, DRAW("draw", .uses = NULL)) },
    { ROW(RG_ERROR_NO_TARGET, "third",
          { "compute", RG_COMPUTE, .color = RG_TARGETS([7] = { CLEARED(third) }),
            .comp = &small_graph_shader, .record = small_graph_record,
            .uses = RG_USES({ WRITE_OTHER }) }) },
    { ROW(RG_ERROR_NO_TARGET, "third",
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }, { 0 }, { &third }))) },
    { ROW(RG_ERROR_TARGET_SIZE, "small",
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }, { CLEARED(small) }))) },
    { ROW(RG_ERROR_TARGET_SIZE, "depth",
          DRAW("draw", .color = RG_TARGETS({ CLEARED(small) }), .depth = { CLEARED(depth) })) },
    { ROW(RG_ERROR_TARGET_SIZE, "chain",
          DRAW("draw",
               .color = RG_TARGETS({ CLEARED(OTHER) }, { &chain, RG_LOAD_CLEAR, .mip = 1 }))) },
    { ROW(RG_ERROR_FORMAT, "other", DRAW("draw", .depth = { CLEARED(OTHER) })) },
    { ROW(RG_ERROR_FORMAT, "depth", FILL(depth)) },
    { ROW(RG_ERROR_WRITES_NOTHING, NULL,
          COMPUTE("compute", { .image = &PICTURE, .access = RG_SAMPLED })) },
    { ROW(RG_ERROR_WRITES_NOTHING, NULL, { "copy", RG_TRANSFER, .record = small_graph_record }) },
    { ROW(RG_ERROR_REPEAT, NULL,
          { "compute", RG_COMPUTE, .repeat = RG_PER_LAYER, .comp = &small_graph_shader,
            .record = small_graph_record,
            .uses = RG_USES({ .buffer = &bytes, .access = RG_STORAGE_WRITE }) }) },
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "other",
          COMPUTE("compute", { .image = &OTHER, .access = RG_STORAGE_READ_WRITE })) },
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "bytes", ALSO(.buffer = &bytes, .access = RG_UNIFORM)) },
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "other", DRAW("draw", .color = RG_TARGETS({ &OTHER }))) },
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "depth",
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }), .depth = { &depth },
               .depth_read_only = true)) },
    {
        .error = RG_ERROR_READ_BEFORE_WRITE, /* only the first mip is there */
        .resource = "chain",
        .row = true,
        .row_count = 2,
        .rows = { DRAW("first", .color = RG_TARGETS({ CLEARED(chain) })),
                  ALSO(&chain, .access = RG_SAMPLED) },
    },
    /* an import of undefined content */
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "other", DRAW("draw", .color = RG_TARGETS({ &OTHER }))),
      .imports = { { .image = &OTHER } } },
};

static const struct fault_case use_cases[] = {
    { ROW(RG_ERROR_NOT_ONE_RESOURCE, "picture",
          ALSO(&PICTURE, .buffer = &bytes, .access = RG_SAMPLED)) },
    { ROW(RG_ERROR_NOT_ONE_RESOURCE, NULL, ALSO(.access = RG_SAMPLED)) },
    { ROW(RG_ERROR_NOT_ONE_RESOURCE, "picture", ALSO(&PICTURE)) },
    { ROW(RG_ERROR_NOT_ONE_RESOURCE, "picture", ALSO(&PICTURE, .access = WILD)) },
    { ROW(RG_ERROR_DUPLICATE_BINDING, "picture",
          ALSO(&PICTURE, .access = RG_SAMPLED, .binding = 9)) },
    { ROW(RG_ERROR_ACCESS, "picture",
          COPY("copy", { &OTHER, .access = RG_COPY_DST }, { &PICTURE, .access = RG_SAMPLED })) },
    { ROW(RG_ERROR_ACCESS, "picture", ALSO(&PICTURE, .access = RG_COPY_SRC)) },
    { ROW(RG_ERROR_ACCESS, "upload", ALSO(.buffer = &upload, .access = RG_VERTEX)) },
    { ROW(RG_ERROR_ACCESS, "upload",
          COPY("copy", { &OTHER, .access = RG_COPY_DST },
               { .buffer = &upload, .access = RG_INDIRECT })) },
    { ROW(RG_ERROR_ACCESS, "third", ALSO(&third, .access = RG_COLOR)) },
    { ROW(RG_ERROR_ACCESS, "picture", ALSO(&PICTURE, .access = RG_HOST_READ)) },
    { ROW(RG_ERROR_ACCESS, "picture", ALSO(&PICTURE, .access = RG_UNIFORM)) },
    { ROW(RG_ERROR_ACCESS, "upload", ALSO(.buffer = &upload, .access = RG_SAMPLED)) },
    { ROW(RG_ERROR_ACCESS, "texels",
          ALSO(.buffer = &texels, .access = RG_SAMPLED, .sampler = &linear)) },
    { ROW(RG_ERROR_ACCESS, "upload",
          COMPUTE("compute", { .buffer = &upload, .access = RG_STORAGE_WRITE })) },
    { ROW(RG_ERROR_ACCESS, NULL,
          { "compute", RG_COMPUTE, .color = RG_TARGETS({ CLEARED(third) }),
            .comp = &small_graph_shader, .record = small_graph_record,
            .uses = RG_USES({ WRITE_OTHER }) }) },
    { ROW(RG_ERROR_ACCESS, NULL,
          { "compute", RG_COMPUTE, .area = small_graph_area, .comp = &small_graph_shader,
            .record = small_graph_record, .uses = RG_USES({ WRITE_OTHER }) }) },
    {
        .error = RG_ERROR_ACCESS, /* a clear that would not happen */
        .resource = "depth",
        .row = true,
        .row_count = 2,
        .rows = { DRAW("first", .depth = { CLEARED(depth) }),
                  DRAW("second", .color = RG_TARGETS({ CLEARED(OTHER) }),
                       .depth = { CLEARED(depth) }, .depth_read_only = true) },
    },
    { ROW(RG_ERROR_CONFLICT, "other",
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }, { CLEARED(OTHER) }))) },
    { ROW(RG_ERROR_CONFLICT, "picture",
          DRAW("draw", .color = RG_TARGETS({ &PICTURE }),
               .uses = RG_USES({ &PICTURE, .access = RG_SAMPLED }))) },
    { ROW(RG_ERROR_CONFLICT, "picture",
          COMPUTE("compute", { &PICTURE, .access = RG_STORAGE_READ },
                  { &PICTURE, .access = RG_STORAGE_WRITE, .binding = 1 })) },
    { .text = "bad row 0 (compute): picture has conflicting uses in one pass; 'storage read at "
              "binding 0' and 'sampled at binding 1': split the pass in two, or read another mip, "
              "layer or image", /* no layout for both */
      ROW(RG_ERROR_CONFLICT, "picture",
          COMPUTE("compute", { WRITE_OTHER }, { &PICTURE, .access = RG_STORAGE_READ },
                  { &PICTURE, .access = RG_SAMPLED, .binding = 1 })) },
    { ROW(
        RG_ERROR_CONFLICT, "bytes",
        COMPUTE("compute", { .buffer = &bytes, .access = RG_STORAGE_WRITE },
                { .buffer = &bytes, .access = RG_STORAGE_WRITE, .binding = 1, .partial = true })) },
    { ROW(RG_ERROR_CONFLICT, "pages", /* in layer 1 */
          DRAW("draw", .color = RG_TARGETS({ &pages, RG_LOAD_CLEAR, .layer = 1 },
                                           { &pages, RG_LOAD_CLEAR, .layer = 1 }))) },
};

#define READ_PICTURE(...) \
    COMPUTE("compute", { WRITE_OTHER }, \
            { &PICTURE, .access = RG_SAMPLED, .range = { __VA_ARGS__ } })
#define RANGE(name, ...) ROW(RG_ERROR_RANGE, name, __VA_ARGS__)

static const struct fault_case range_cases[] = {
    { RANGE("other", DRAW("draw", .color = RG_TARGETS({ &OTHER, RG_LOAD_CLEAR, .mip = 1 }))) },
    { RANGE("other", DRAW("draw", .color = RG_TARGETS({ &OTHER, RG_LOAD_CLEAR, .mip = WILD }))) },
    { RANGE("other", DRAW("draw", .color = RG_TARGETS({ &OTHER, RG_LOAD_CLEAR, .layer = 1 }))) },
    { RANGE("other", DRAW("draw", .color = RG_TARGETS({ &OTHER, RG_LOAD_CLEAR, .layer = WILD }))) },
    { RANGE("pages", DRAW("draw", .color = RG_TARGETS({ &pages, RG_LOAD_CLEAR, .layer = 4 }),
                          .repeat = RG_PER_LAYER)) },
    { RANGE("chain", DRAW("draw", .color = RG_TARGETS({ &chain, RG_LOAD_CLEAR, .mip = 3 }),
                          .repeat = RG_PER_MIP)) },
    { RANGE("few", DRAW("draw", .color = RG_TARGETS({ CLEARED(pages) }, { CLEARED(few) }),
                        .repeat = RG_PER_LAYER)) },
    { RANGE("depth", DRAW("draw", .color = RG_TARGETS({ CLEARED(chain) }), .repeat = RG_PER_MIP,
                          .depth = { &depth, RG_LOAD_CLEAR, .mip = WILD })) },
    { RANGE("picture", READ_PICTURE(.mip = 1)) },
    { RANGE("picture", READ_PICTURE(.mip = WILD, .mip_count = WILD)) },
    { RANGE("picture", READ_PICTURE(.mip_count = 2)) },
    { RANGE("picture", READ_PICTURE(.mip_count = WILD)) },
    { RANGE("picture", READ_PICTURE(.layer = 1)) },
    { RANGE("picture", READ_PICTURE(.layer = WILD, .layer_count = 2)) },
    { RANGE("picture", READ_PICTURE(.layer_count = WILD)) },
    { RANGE("picture", READ_PICTURE(.aspect = VK_IMAGE_ASPECT_DEPTH_BIT)) },
    { RANGE("picture", READ_PICTURE(.aspect = WILD)) },
    { RANGE("picture",
            { "compute", RG_COMPUTE, .repeat = RG_PER_LAYER, .comp = &small_graph_shader,
              .record = small_graph_record,
              .uses = RG_USES({ &pages, .access = RG_STORAGE_WRITE, .range = { .each = true } },
                              { &PICTURE, .access = RG_SAMPLED, .binding = 1,
                                .range = { .layer = WILD, .each = true } }) }) },
    {
        .error = RG_ERROR_RANGE, /* a shader sees depth or stencil */
        .resource = "stencil",
        .row = true,
        .row_count = 2,
        .rows = { DRAW("first", .depth = { CLEARED(stencil) }),
                  ALSO(&stencil, .access = RG_SAMPLED) },
    },
};

/* The device's word on formats counts for passes that run. */
static const struct fault_case device_cases[] = {
    { ROW(RG_ERROR_FORMAT, "depth",
          DRAW("draw", .color = RG_TARGETS({ &PICTURE }), .depth = { CLEARED(depth) })),
      .device = &plain_device },
    { ROW(RG_ERROR_FORMAT, "other",
          DRAW("draw", .color = RG_TARGETS({ &PICTURE }),
               .uses = RG_USES({ &OTHER, .access = RG_SAMPLED, .sampler = &linear }))),
      .imports = { { .image = &OTHER, .access = RG_SAMPLED } }, .device = &plain_device },
    { ROW(RG_ERROR_FORMAT, "picture",
          DRAW("draw", .color = RG_TARGETS({ &PICTURE, .blend = RG_BLEND_ADD }))),
      .device = &plain_device },
};

static const struct fault_cases all_cases[] = {
    FAULT_CASES(params_cases), FAULT_CASES(resource_cases), FAULT_CASES(row_cases),
    FAULT_CASES(use_cases),    FAULT_CASES(range_cases),    FAULT_CASES(device_cases),
};

static void test_every_case(void **state)
{
    (void)state;
    bool provoked[RG_ERROR_COUNT] = { false };
    fault_case_check(all_cases, sizeof(all_cases) / sizeof(all_cases[0]), provoked);
    for (int error = RG_ERROR_NONE + 1; error < RG_ERROR_SAMPLES; error++) {
        if (!provoked[error])
            print_error("no case provokes error %d\n", error);
        assert_true(provoked[error]);
    }
}

static void test_no_fault_without_cause(void **state)
{
    (void)state;
    struct rg_plan *plan = fault_case_compile(&(struct fault_case){ 0 });
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(plan->pass_count, 1);
    rg_plan_destroy(plan);
}

static bool has_fault(const struct rg_plan *plan, enum rg_error error, const char *resource)
{
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        if (plan->faults[i].error == error &&
            fault_case_same_text(plan->faults[i].resource, resource))
            return true;
    }
    return false;
}

static void test_all_at_once(void **state)
{
    (void)state;
    const struct fault_case fc = {
        .row_count = 2,
        .rows = {
            { .name = "fill",
              .color = RG_TARGETS({ CLEARED(wide) }),
              .frag = &small_graph_shader,
              .push_size = 7 },
            COMPUTE("compute", { .buffer = &bytes, .access = RG_UNIFORM },
                    { .image = &pages, .access = RG_STORAGE_WRITE, .range.layer = 5 }),
        },
        .outputs = { { .image = &third, .access = RG_SAMPLED } },
        .no_view = true,
    };
    struct rg_plan *plan = fault_case_compile(&fc);
    assert_non_null(plan);
    assert_true(has_fault(plan, RG_ERROR_NO_SIZE, NULL));
    assert_true(has_fault(plan, RG_ERROR_TOO_LARGE, "wide"));
    assert_true(has_fault(plan, RG_ERROR_DUPLICATE_NAME, NULL));
    assert_true(has_fault(plan, RG_ERROR_NO_RECORD, NULL));
    assert_true(has_fault(plan, RG_ERROR_NO_SHADER, NULL));
    assert_true(has_fault(plan, RG_ERROR_PUSH_SIZE, NULL));
    assert_true(has_fault(plan, RG_ERROR_DUPLICATE_BINDING, "pages"));
    assert_true(has_fault(plan, RG_ERROR_RANGE, "pages"));
    assert_true(has_fault(plan, RG_ERROR_READ_BEFORE_WRITE, "bytes"));
    assert_true(has_fault(plan, RG_ERROR_OUTPUT_NOT_WRITTEN, "third"));
    assert_int_equal(plan->fault_count, 10);
    assert_int_equal(plan->pass_count, 0);
    rg_plan_destroy(plan);
}

static void test_repetitions_report_once(void **state)
{
    (void)state;
    const struct fault_case fc = {
        .row_count = 1,
        .rows = { DRAW("draw", .repeat = RG_PER_LAYER, .color = RG_TARGETS({ &pages }),
                       .uses = RG_USES({ &OTHER, .access = RG_SAMPLED })) },
    };
    struct rg_plan *plan = fault_case_compile(&fc);
    assert_non_null(plan);
    assert_true(has_fault(plan, RG_ERROR_READ_BEFORE_WRITE, "pages"));
    assert_true(has_fault(plan, RG_ERROR_READ_BEFORE_WRITE, "other"));
    assert_int_equal(plan->fault_count, 2);
    rg_plan_destroy(plan);
}

/* Every format is refused, by every pass that runs, and by no other. */
static void test_faults_of_formats(void **state)
{
    (void)state;
    const struct fault_case fc = {
        .row_count = 2,
        .rows = { DRAW("culled", .color = RG_TARGETS({ CLEARED(OTHER) })),
                  DRAW("draw", .color = RG_TARGETS({ &PICTURE })) },
        .device = &sampling_device,
    };
    struct rg_plan *plan = fault_case_compile(&fc);
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 2);
    assert_string_equal(plan->faults[0].pass, "fill");
    assert_string_equal(plan->faults[1].pass, "draw");
    assert_int_equal(plan->pass_count, 0);
    rg_dump(plan, stderr);
    rg_plan_destroy(plan);
}

static void test_no_techniques(void **state)
{
    (void)state;
    const struct rg_output output = { .image = &PICTURE, .access = RG_SAMPLED };
    struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
        .view = { FAULT_CASE_VIEW, FAULT_CASE_VIEW },
        .outputs = &output,
        .output_count = 1,
    });
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 1);
    assert_int_equal(plan->faults[0].error, RG_ERROR_OUTPUT_NOT_WRITTEN);
    rg_plan_destroy(plan);
}

static void test_short_of_room(void **state)
{
    (void)state;
    char name[300];
    memset(name, 'x', sizeof(name));
    name[sizeof(name) - 1] = '\0';
    const struct rg_fault fault = { RG_ERROR_FORMAT, name, NULL, name, 3, "hint" };
    char text[8];
    int length = rg_fault_text(&fault, NULL, 0);
    assert_true(length > 600);
    assert_int_equal(rg_fault_text(&fault, text, sizeof(text)), length);
    assert_int_equal(strlen(text), 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_case),        cmocka_unit_test(test_no_fault_without_cause),
        cmocka_unit_test(test_all_at_once),       cmocka_unit_test(test_repetitions_report_once),
        cmocka_unit_test(test_faults_of_formats), cmocka_unit_test(test_no_techniques),
        cmocka_unit_test(test_short_of_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
