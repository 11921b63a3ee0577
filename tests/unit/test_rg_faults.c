/* Every fault the compiler of plans can find: one small table for each way to provoke it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/rg.h"
#include "tests/support/check.h"
#include "tests/support/small_graph.h"

enum {
    VIEW = 64,
    ROWS = 2,
};

#define COLOR_FORMAT VK_FORMAT_R8G8B8A8_UNORM
#define WILD         UINT32_MAX

/* ---- resources, good ones first ---- */

static const struct rg_image picture = { .name = "picture", .format = COLOR_FORMAT };
static const struct rg_image other = { .name = "other", .format = COLOR_FORMAT };
static const struct rg_image third = { .name = "third", .format = COLOR_FORMAT };
static const struct rg_image small = { .name = "small", .format = COLOR_FORMAT, .scale = 0.5f };
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_image stencil = { .name = "stencil", .format = VK_FORMAT_D24_UNORM_S8_UINT };
static const struct rg_image chain = { .name = "chain", .format = COLOR_FORMAT, .mips = 3 };
static const struct rg_image pages = { .name = "pages", .format = COLOR_FORMAT, .layers = 4 };
static const struct rg_image few = { .name = "few", .format = COLOR_FORMAT, .layers = 2 };
static const struct rg_buffer bytes = { .name = "bytes", .size = 64 };
static const struct rg_buffer upload = { "upload", 64, 0, RG_MEMORY_UPLOAD };

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
static const struct rg_device small_device = { .max_image_size = VIEW - 1 };
static const struct rg_device thin_device = { .max_layers = 3 };

static const struct rg_sampler linear = { .linear = true };

/* ---- cases ---- */

/* Rows that say little more than one resource; ALSO reads it and writes another. */
#define FILL(to)    DRAW("draw", .color[0] = { CLEARED(to) })
#define COPY_TO(to) COPY("copy", { .buffer = &(to), .access = RG_COPY_DST })
#define ALSO(...)   COMPUTE("compute", { WRITE_OTHER }, { __VA_ARGS__ })
#define WRITE_OTHER .image = &other, .access = RG_STORAGE_WRITE, .binding = 9

/*
 * Before the rows of a case, in a technique of its own, a good row writes `picture`, which is the
 * output unless the case has outputs. One fault is expected, in the last row if it lies in a row.
 */
struct fault_case {
    enum rg_error error;
    const char *resource; /* that the fault names; NULL: none */
    bool row;             /* it lies in a row */
    uint32_t row_count;
    struct rg_pass rows[ROWS];
    struct rg_output outputs[2];
    struct rg_import imports[2];
    const struct rg_device *device;
    bool no_output, no_view, nameless_technique;
};

/* A fault in the only row, of a resource (NULL: none). */
#define ROW(kind, name, ...) \
    .error = (kind), .resource = (name), .row = true, .row_count = 1, .rows = { __VA_ARGS__ }
/* A fault outside the rows, which a good or bad row may lead to. */
#define AROUND(kind, name, ...) \
    .error = (kind), .resource = (name), .row_count = 1, .rows = { __VA_ARGS__ }
#define OUTPUT(kind, name, ...) .error = (kind), .resource = (name), .outputs = { __VA_ARGS__ }
#define IMPORT(kind, name, ...) .error = (kind), .resource = (name), .imports = { __VA_ARGS__ }

static const struct fault_case params_cases[] = {
    { .error = RG_ERROR_NO_OUTPUT, .no_output = true },
    { .error = RG_ERROR_NO_SIZE, .no_view = true },
    { .error = RG_ERROR_NO_NAME, .nameless_technique = true },
    { OUTPUT(RG_ERROR_OUTPUT_NOT_WRITTEN, "other", { .image = &other, .access = RG_SAMPLED }) },
    { OUTPUT(RG_ERROR_OUTPUT_NOT_WRITTEN, "bytes", { .buffer = &bytes, .access = RG_COPY_SRC }) },
    { OUTPUT(RG_ERROR_LISTED_TWICE, "picture", { .image = &picture, .access = RG_SAMPLED },
             { .image = &picture, .access = RG_COPY_SRC }) },
    { OUTPUT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .image = &picture, .buffer = &bytes }) },
    { OUTPUT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .access = RG_SAMPLED }) },
    { OUTPUT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .image = &picture }) },
    { OUTPUT(RG_ERROR_ACCESS, "picture", { .image = &picture, .access = RG_UNIFORM }) },
    { OUTPUT(RG_ERROR_ACCESS, "picture", { .image = &picture, .access = RG_DEPTH_READ }) },
    { OUTPUT(RG_ERROR_ACCESS, "picture", { .image = &picture, .access = RG_PRESENT }) },
    { OUTPUT(RG_ERROR_ACCESS, "picture", { .image = &picture, .access = RG_HOST_READ }) },
    { IMPORT(RG_ERROR_LISTED_TWICE, "other", { .image = &other, .access = RG_SAMPLED },
             { .image = &other }) },
    { IMPORT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .image = &other, .buffer = &bytes }) },
    { IMPORT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .access = RG_SAMPLED }) },
    { IMPORT(RG_ERROR_NOT_ONE_RESOURCE, NULL, { .image = &other, .access = RG_ACCESS_COUNT }) },
    { IMPORT(RG_ERROR_ACCESS, "other", { .image = &other, .access = RG_HOST_READ }) },
    { IMPORT(RG_ERROR_ACCESS, "other", { .image = &other, .access = RG_VERTEX }) },
    { IMPORT(RG_ERROR_ACCESS, "depth", { .image = &depth, .access = RG_COLOR }) },
    { IMPORT(RG_ERROR_ACCESS, "bytes", { .buffer = &bytes, .access = RG_PRESENT }) },
    { IMPORT(RG_ERROR_RANGE, "other", { .image = &other, .access = RG_SAMPLED, .mips = WILD }) },
    { IMPORT(RG_ERROR_TOO_LARGE, "other", { .image = &other, .extent = { WILD, WILD } }) },
    { IMPORT(RG_ERROR_TOO_LARGE, "bytes", { .buffer = &bytes, .size = UINT64_MAX }) },
};

static const struct fault_case resource_cases[] = {
    { AROUND(RG_ERROR_NO_NAME, "?", FILL(nameless)) },
    { AROUND(RG_ERROR_DUPLICATE_NAME, "other",
             DRAW("draw", .color = { { CLEARED(other) }, { CLEARED(twin) } })) },
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
    { ROW(RG_ERROR_NO_NAME, NULL, DRAW(NULL, .color[0] = { CLEARED(other) })) },
    { ROW(RG_ERROR_DUPLICATE_NAME, NULL, DRAW("fill", .color[0] = { CLEARED(other) })) },
    { ROW(RG_ERROR_NO_RECORD, NULL,
          { .name = "draw",
            .vert = &small_graph_shader,
            .frag = &small_graph_shader,
            .color[0] = { CLEARED(other) } }) },
    { ROW(RG_ERROR_NO_SHADER, NULL,
          { .name = "draw",
            .frag = &small_graph_shader,
            .record = small_graph_record,
            .color[0] = { CLEARED(other) } }) },
    { ROW(RG_ERROR_NO_SHADER, NULL,
          { .name = "draw",
            .vert = &small_graph_shader,
            .record = small_graph_record,
            .color[0] = { CLEARED(other) } }) },
    { ROW(RG_ERROR_NO_SHADER, NULL,
          { "compute", RG_COMPUTE, .record = small_graph_record,
            .uses = RG_USES({ WRITE_OTHER }) }) },
    { ROW(RG_ERROR_PUSH_SIZE, NULL,
          DRAW("draw", .color[0] = { CLEARED(other) }, .push_size = 132)) },
    { ROW(RG_ERROR_PUSH_SIZE, NULL, DRAW("draw", .color[0] = { CLEARED(other) }, .push_size = 6)) },
    { ROW(RG_ERROR_NO_TARGET, NULL, DRAW("draw", .uses = NULL)) },
    { ROW(RG_ERROR_NO_TARGET, "third",
          DRAW("draw", .color = { { CLEARED(other) }, { 0 }, { &third } })) },
    { ROW(RG_ERROR_TARGET_SIZE, "small",
          DRAW("draw", .color = { { CLEARED(other) }, { CLEARED(small) } })) },
    { ROW(RG_ERROR_TARGET_SIZE, "depth",
          DRAW("draw", .color[0] = { CLEARED(small) }, .depth = { CLEARED(depth) })) },
    { ROW(RG_ERROR_TARGET_SIZE, "chain",
          DRAW("draw", .color = { { CLEARED(other) }, { &chain, RG_LOAD_CLEAR, .mip = 1 } })) },
    { ROW(RG_ERROR_FORMAT, "other", DRAW("draw", .depth = { CLEARED(other) })) },
    { ROW(RG_ERROR_FORMAT, "depth", FILL(depth)) },
    { ROW(RG_ERROR_WRITES_NOTHING, NULL,
          COMPUTE("compute", { .image = &picture, .access = RG_SAMPLED })) },
    { ROW(RG_ERROR_WRITES_NOTHING, NULL, { "copy", RG_TRANSFER, .record = small_graph_record }) },
    { ROW(RG_ERROR_REPEAT, NULL,
          { "compute", RG_COMPUTE, RG_PER_LAYER, .comp = &small_graph_shader,
            .record = small_graph_record,
            .uses = RG_USES({ .buffer = &bytes, .access = RG_STORAGE_WRITE }) }) },
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "other",
          COMPUTE("compute", { .image = &other, .access = RG_STORAGE_READ_WRITE })) },
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "bytes", ALSO(.buffer = &bytes, .access = RG_UNIFORM)) },
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "other", DRAW("draw", .color[0] = { &other })) },
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "depth",
          DRAW("draw", .color[0] = { CLEARED(other) }, .depth = { &depth },
               .depth_read_only = true)) },
    {
        .error = RG_ERROR_READ_BEFORE_WRITE, /* only the first mip is there */
        .resource = "chain",
        .row = true,
        .row_count = 2,
        .rows = { DRAW("first", .color[0] = { CLEARED(chain) }),
                  ALSO(&chain, .access = RG_SAMPLED) },
    },
    /* an import of undefined content */
    { ROW(RG_ERROR_READ_BEFORE_WRITE, "other", DRAW("draw", .color[0] = { &other })),
      .imports = { { .image = &other } } },
};

static const struct fault_case use_cases[] = {
    { ROW(RG_ERROR_NOT_ONE_RESOURCE, "picture",
          ALSO(&picture, .buffer = &bytes, .access = RG_SAMPLED)) },
    { ROW(RG_ERROR_NOT_ONE_RESOURCE, NULL, ALSO(.access = RG_SAMPLED)) },
    { ROW(RG_ERROR_NOT_ONE_RESOURCE, "picture", ALSO(&picture)) },
    { ROW(RG_ERROR_NOT_ONE_RESOURCE, "picture", ALSO(&picture, .access = WILD)) },
    { ROW(RG_ERROR_DUPLICATE_BINDING, "picture",
          ALSO(&picture, .access = RG_SAMPLED, .binding = 9)) },
    { ROW(RG_ERROR_ACCESS, "picture",
          COPY("copy", { &other, .access = RG_COPY_DST }, { &picture, .access = RG_SAMPLED })) },
    { ROW(RG_ERROR_ACCESS, "picture", ALSO(&picture, .access = RG_COPY_SRC)) },
    { ROW(RG_ERROR_ACCESS, "upload", ALSO(.buffer = &upload, .access = RG_VERTEX)) },
    { ROW(RG_ERROR_ACCESS, "upload",
          COPY("copy", { &other, .access = RG_COPY_DST },
               { .buffer = &upload, .access = RG_INDIRECT })) },
    { ROW(RG_ERROR_ACCESS, "third", ALSO(&third, .access = RG_COLOR)) },
    { ROW(RG_ERROR_ACCESS, "picture", ALSO(&picture, .access = RG_HOST_READ)) },
    { ROW(RG_ERROR_ACCESS, "picture", ALSO(&picture, .access = RG_UNIFORM)) },
    { ROW(RG_ERROR_ACCESS, "upload", ALSO(.buffer = &upload, .access = RG_SAMPLED)) },
    { ROW(RG_ERROR_ACCESS, "upload",
          COMPUTE("compute", { .buffer = &upload, .access = RG_STORAGE_WRITE })) },
    { ROW(RG_ERROR_ACCESS, NULL,
          { "compute", RG_COMPUTE, .color[0] = { CLEARED(third) }, .comp = &small_graph_shader,
            .record = small_graph_record, .uses = RG_USES({ WRITE_OTHER }) }) },
    {
        .error = RG_ERROR_ACCESS, /* a clear that would not happen */
        .resource = "depth",
        .row = true,
        .row_count = 2,
        .rows = { DRAW("first", .depth = { CLEARED(depth) }),
                  DRAW("second", .color[0] = { CLEARED(other) }, .depth = { CLEARED(depth) },
                       .depth_read_only = true) },
    },
    { ROW(RG_ERROR_CONFLICT, "other",
          DRAW("draw", .color = { { CLEARED(other) }, { CLEARED(other) } })) },
    { ROW(RG_ERROR_CONFLICT, "picture",
          DRAW("draw", .color[0] = { &picture },
               .uses = RG_USES({ &picture, .access = RG_SAMPLED }))) },
    { ROW(RG_ERROR_CONFLICT, "picture",
          COMPUTE("compute", { &picture, .access = RG_STORAGE_READ },
                  { &picture, .access = RG_STORAGE_WRITE, .binding = 1 })) },
    { ROW(RG_ERROR_CONFLICT, "picture", /* two reads, but no layout for both */
          COMPUTE("compute", { WRITE_OTHER }, { &picture, .access = RG_STORAGE_READ },
                  { &picture, .access = RG_SAMPLED, .binding = 1 })) },
    { ROW(
        RG_ERROR_CONFLICT, "bytes",
        COMPUTE("compute", { .buffer = &bytes, .access = RG_STORAGE_WRITE },
                { .buffer = &bytes, .access = RG_STORAGE_WRITE, .binding = 1, .partial = true })) },
    { ROW(RG_ERROR_CONFLICT, "pages", /* in layer 1 */
          DRAW("draw", .color = { { &pages, RG_LOAD_CLEAR, .layer = 1 },
                                  { &pages, RG_LOAD_CLEAR, .layer = 1 } })) },
};

#define READ_PICTURE(...) \
    COMPUTE("compute", { WRITE_OTHER }, \
            { &picture, .access = RG_SAMPLED, .range = { __VA_ARGS__ } })
#define RANGE(name, ...) ROW(RG_ERROR_RANGE, name, __VA_ARGS__)

static const struct fault_case range_cases[] = {
    { RANGE("other", DRAW("draw", .color[0] = { &other, RG_LOAD_CLEAR, .mip = 1 })) },
    { RANGE("other", DRAW("draw", .color[0] = { &other, RG_LOAD_CLEAR, .mip = WILD })) },
    { RANGE("other", DRAW("draw", .color[0] = { &other, RG_LOAD_CLEAR, .layer = 1 })) },
    { RANGE("other", DRAW("draw", .color[0] = { &other, RG_LOAD_CLEAR, .layer = WILD })) },
    { RANGE("pages", DRAW("draw", .color[0] = { &pages, RG_LOAD_CLEAR, .layer = 4 },
                          .repeat = RG_PER_LAYER)) },
    { RANGE("chain",
            DRAW("draw", .color[0] = { &chain, RG_LOAD_CLEAR, .mip = 3 }, .repeat = RG_PER_MIP)) },
    { RANGE("few", DRAW("draw", .color = { { CLEARED(pages) }, { CLEARED(few) } },
                        .repeat = RG_PER_LAYER)) },
    { RANGE("depth", DRAW("draw", .color[0] = { CLEARED(chain) }, .repeat = RG_PER_MIP,
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
            { "compute", RG_COMPUTE, RG_PER_LAYER, .comp = &small_graph_shader,
              .record = small_graph_record,
              .uses = RG_USES({ &pages, .access = RG_STORAGE_WRITE, .range = { .each = true } },
                              { &picture, .access = RG_SAMPLED, .binding = 1,
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
          DRAW("draw", .color[0] = { &picture }, .depth = { CLEARED(depth) })),
      .device = &plain_device },
    { ROW(RG_ERROR_FORMAT, "other",
          DRAW("draw", .color[0] = { &picture },
               .uses = RG_USES({ &other, .access = RG_SAMPLED, .sampler = &linear }))),
      .imports = { { .image = &other, .access = RG_SAMPLED } }, .device = &plain_device },
    { ROW(RG_ERROR_FORMAT, "picture",
          DRAW("draw", .color[0] = { &picture, .blend = RG_BLEND_ADD })),
      .device = &plain_device },
};

#define CASES(table) \
    { \
        table, sizeof(table) / sizeof((table)[0]) \
    }

static const struct {
    const struct fault_case *cases;
    size_t count;
} all_cases[] = {
    CASES(params_cases), CASES(resource_cases), CASES(row_cases),
    CASES(use_cases),    CASES(range_cases),    CASES(device_cases),
};

/* ---- judging them ---- */

static const struct rg_pass good_rows[] = { DRAW("fill", .color[0] = { CLEARED(picture) }) };

static struct rg_plan *compile_case(const struct fault_case *fc)
{
    const struct rg_technique good = RG_TECHNIQUE("good", good_rows);
    const struct rg_technique bad = {
        .name = fc->nameless_technique ? NULL : "bad",
        .passes = fc->rows,
        .pass_count = fc->row_count,
    };
    const struct rg_technique *const techniques[] = { &good, &bad };
    const struct rg_output wanted = { .image = &picture, .access = RG_SAMPLED };
    bool own = fc->outputs[0].image || fc->outputs[0].buffer || fc->outputs[0].access;
    bool second_output = fc->outputs[1].image;
    bool import = fc->imports[0].image || fc->imports[0].buffer || fc->imports[0].access;
    bool second_import = fc->imports[1].image;
    return rg_compile(&(struct rg_compile_params){
        .techniques = techniques,
        .technique_count = 2,
        .view = { VIEW, fc->no_view ? 0 : VIEW },
        .outputs = own ? fc->outputs : &wanted,
        .output_count = fc->no_output   ? 0
                        : second_output ? 2
                                        : 1,
        .imports = fc->imports,
        .import_count = second_import ? 2
                        : import      ? 1
                                      : 0,
        .device = fc->device,
    });
}

static bool same_text(const char *a, const char *b)
{
    return a && b ? !strcmp(a, b) : a == b;
}

static void check_text(const struct rg_fault *fault)
{
    char text[512];
    const char *const names[] = { fault->technique, fault->pass, fault->resource, fault->hint };
    int length = rg_fault_text(fault, text, sizeof(text));
    assert_int_equal(length, strlen(text));
    assert_null(strchr(text, '\n'));
    assert_non_null(fault->hint);
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
        assert_true(!names[i] || strstr(text, names[i]));
    char row[32];
    snprintf(row, sizeof(row), "row %u", fault->row);
    assert_true((strstr(text, row) != NULL) == (fault->row != RG_NONE));
}

static bool is_expected(const struct fault_case *fc, const struct rg_fault *fault)
{
    const char *technique = fc->row ? "bad" : NULL;
    const char *pass = fc->row ? fc->rows[fc->row_count - 1].name : NULL;
    uint32_t row = fc->row ? fc->row_count - 1 : RG_NONE;
    return fault->error == fc->error && same_text(fault->technique, technique) &&
           same_text(fault->pass, pass) && same_text(fault->resource, fc->resource) &&
           fault->row == row;
}

static void check_case(const struct fault_case *fc)
{
    struct rg_plan *plan = compile_case(fc);
    assert_non_null(plan);
    bool good = plan->fault_count == 1 && is_expected(fc, &plan->faults[0]);
    if (!good) {
        print_error("error %d of %s expected, found:\n", (int)fc->error,
                    fc->resource ? fc->resource : "nothing");
        rg_dump(plan, stderr);
    }
    assert_true(good);
    check_text(&plan->faults[0]);
    assert_int_equal(plan->pass_count, 0);
    rg_plan_destroy(plan);
}

static void test_every_case(void **state)
{
    (void)state;
    bool provoked[RG_ERROR_COUNT] = { false };
    for (size_t t = 0; t < sizeof(all_cases) / sizeof(all_cases[0]); t++) {
        for (size_t i = 0; i < all_cases[t].count; i++) {
            check_case(&all_cases[t].cases[i]);
            provoked[all_cases[t].cases[i].error] = true;
        }
    }
    for (int error = RG_ERROR_NONE + 1; error < RG_ERROR_COUNT; error++) {
        if (!provoked[error])
            print_error("no case provokes error %d\n", error);
        assert_true(provoked[error]);
    }
}

static void test_no_fault_without_cause(void **state)
{
    (void)state;
    struct rg_plan *plan = compile_case(&(struct fault_case){ 0 });
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(plan->pass_count, 1);
    rg_plan_destroy(plan);
}

static bool has_fault(const struct rg_plan *plan, enum rg_error error, const char *resource)
{
    for (uint32_t i = 0; i < plan->fault_count; i++) {
        if (plan->faults[i].error == error && same_text(plan->faults[i].resource, resource))
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
            { .name = "fill", .color[0] = { CLEARED(wide) }, .push_size = 7 },
            COMPUTE("compute", { .buffer = &bytes, .access = RG_UNIFORM },
                    { .image = &pages, .access = RG_STORAGE_WRITE, .range.layer = 5 }),
        },
        .outputs = { { .image = &third, .access = RG_SAMPLED } },
        .no_view = true,
    };
    struct rg_plan *plan = compile_case(&fc);
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
        .rows = { DRAW("draw", .repeat = RG_PER_LAYER, .color[0] = { &pages },
                       .uses = RG_USES({ &other, .access = RG_SAMPLED })) },
    };
    struct rg_plan *plan = compile_case(&fc);
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
        .rows = { DRAW("culled", .color[0] = { CLEARED(other) }),
                  DRAW("draw", .color[0] = { &picture }) },
        .device = &sampling_device,
    };
    struct rg_plan *plan = compile_case(&fc);
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 2);
    assert_string_equal(plan->faults[0].pass, "fill");
    assert_string_equal(plan->faults[1].pass, "draw");
    assert_int_equal(plan->pass_count, 0);
    rg_dump_dot(plan, stderr);
    rg_plan_destroy(plan);
}

static void test_no_techniques(void **state)
{
    (void)state;
    const struct rg_output output = { .image = &picture, .access = RG_SAMPLED };
    struct rg_plan *plan = rg_compile(&(struct rg_compile_params){
        .view = { VIEW, VIEW },
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
