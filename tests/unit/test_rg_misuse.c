/* Fields that hold what they cannot: NULL tables, wild counts, numbers of no constant, sizes that
 * no memory has. Each gets one line that names the field. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/rg.h"
#include "graph/rg_exec.h"
#include "tests/support/assertions.h"
#include "tests/support/fault_case.h"

#define COLOR_FORMAT VK_FORMAT_R8G8B8A8_UNORM
#define WILD         FAULT_CASE_WILD

#define PICTURE fault_case_picture
#define OTHER   fault_case_other

static const struct rg_image flat = { "flat", VK_FORMAT_D32_SFLOAT };
static const struct rg_image numbers = { "numbers", VK_FORMAT_R32_UINT };
static const struct rg_image pages = { "pages", COLOR_FORMAT, .layers = 1U << 20 };
static const struct rg_buffer bytes = { "bytes", .size = 64 };
static const struct rg_buffer upload = { "upload", .size = 64, .memory = RG_MEMORY_UPLOAD };
static const struct rg_buffer nowhere = { "nowhere", .size = 64, .memory = (enum rg_memory)99 };

#define NO_TABLE "has a table that is NULL or too long; "
#define NO_VALUE "has an invalid value; "

/* ---- params ---- */

static const struct rg_technique no_rows = { "bad", NULL, 3 };
static const struct rg_technique many_rows = { "bad", &(const struct rg_pass){ 0 }, SIZE_MAX };

static void no_techniques(struct rg_compile_params *params)
{
    params->techniques = NULL;
}

static void many_techniques(struct rg_compile_params *params)
{
    params->technique_count = RG_MAX_ROWS + 1;
}

static void null_technique(struct rg_compile_params *params)
{
    static const struct rg_technique *const techniques[] = { NULL };
    params->techniques = techniques;
    params->technique_count = 1;
}

static void no_passes(struct rg_compile_params *params)
{
    static const struct rg_technique *const techniques[] = { &no_rows };
    params->techniques = techniques;
    params->technique_count = 1;
}

static void many_passes(struct rg_compile_params *params)
{
    static const struct rg_technique *const techniques[] = { &many_rows };
    params->techniques = techniques;
    params->technique_count = 1;
}

static void no_outputs(struct rg_compile_params *params)
{
    params->outputs = NULL;
}

static void many_imports(struct rg_compile_params *params)
{
    params->import_count = SIZE_MAX;
}

static void no_imports(struct rg_compile_params *params)
{
    params->imports = NULL;
    params->import_count = 1;
}

static void small_view(struct rg_compile_params *params)
{
    params->max_view = (VkExtent2D){ FAULT_CASE_VIEW, FAULT_CASE_VIEW - 1 };
}

static void wild_sharing(struct rg_compile_params *params)
{
    params->sharing = (enum rg_sharing)99;
}

static const struct fault_case params_cases[] = {
    { RG_ERROR_TABLE, .edit = no_techniques,
      .text = NO_TABLE "techniques: expected technique_count entries, at most RG_MAX_ROWS" },
    { RG_ERROR_TABLE, .edit = many_techniques,
      .text = NO_TABLE "techniques: expected technique_count entries, at most RG_MAX_ROWS" },
    { RG_ERROR_TABLE, .edit = null_technique,
      .text = NO_TABLE "techniques: expected addresses, got NULL" },
    { RG_ERROR_TABLE, .edit = no_passes,
      .text = "bad: " NO_TABLE "passes: expected pass_count entries, at most RG_MAX_ROWS" },
    { RG_ERROR_TABLE, .edit = many_passes,
      .text = "bad: " NO_TABLE "passes: expected pass_count entries, at most RG_MAX_ROWS" },
    { RG_ERROR_TABLE, .edit = no_outputs,
      .text = NO_TABLE "outputs: expected output_count entries, at most RG_MAX_ROWS" },
    { RG_ERROR_TABLE, .edit = no_imports,
      .text = NO_TABLE "imports: expected import_count entries, at most RG_MAX_ROWS" },
    { RG_ERROR_TABLE, .edit = many_imports,
      .text = NO_TABLE "imports: expected import_count entries, at most RG_MAX_ROWS" },
    { RG_ERROR_TOO_LARGE, .edit = small_view,
      .text = "is too large; view: expected no more than max_view" },
    { RG_ERROR_VALUE, .edit = wild_sharing,
      .text = NO_VALUE "sharing: expected a constant of enum rg_sharing" },
    { IMPORT(RG_ERROR_NO_SIZE, NULL, { .image = &OTHER, .extent = { 0, 9 } }),
      .text = "other has no size; extent: expected width and height of the import, or 0x0 as "
              "declared" },
    { IMPORT(RG_ERROR_PERSISTENT, NULL, { .buffer = &upload, .access = RG_UNIFORM }),
      .text = "upload cannot be persistent or imported; persistent and imported buffers must be "
              "RG_MEMORY_DEVICE" },
};

/* ---- answers of a device ---- */

static struct rg_memory_requirements answer(const void *user, const VkImageCreateInfo *info)
{
    (void)info;
    return *(const struct rg_memory_requirements *)user;
}

static struct rg_memory_requirements answer_buffer(const void *user, const VkBufferCreateInfo *info)
{
    (void)info;
    return *(const struct rg_memory_requirements *)user;
}

#define DEVICE(...) \
    .device = &(const struct rg_device) \
    { \
        .user = &(const struct rg_memory_requirements){ __VA_ARGS__ }, .image_memory = answer, \
        .buffer_memory = answer_buffer, \
    }
#define IMPOSSIBLE \
    "picture has impossible properties on this device; memory: expected a size, a memory type " \
    "and a power-of-two alignment"
#define NO_MEMORY " is too large; make it smaller: the resources so far exceed any memory"

static const struct fault_case device_cases[] = {
    { RG_ERROR_DEVICE, .text = IMPOSSIBLE, DEVICE(0, 256, 1) },
    { RG_ERROR_DEVICE, .text = IMPOSSIBLE, DEVICE(64, 256, 0) },
    { RG_ERROR_DEVICE, .text = IMPOSSIBLE, DEVICE(64, 3, 1) },
    { RG_ERROR_TOO_LARGE, .text = "picture" NO_MEMORY, DEVICE(UINT64_MAX, 1, 1) },
    { RG_ERROR_TOO_LARGE, .text = "picture" NO_MEMORY, DEVICE(1, UINT64_C(1) << 63, 1) },
    { AROUND(RG_ERROR_TOO_LARGE, NULL, FILL(OTHER)), .text = "other" NO_MEMORY,
      .outputs = { { .image = &PICTURE, .access = RG_SAMPLED },
                   { .image = &OTHER, .access = RG_SAMPLED } },
      DEVICE(UINT64_C(1) << 61, 1 << 20, 1) },
    { AROUND(RG_ERROR_TOO_LARGE, NULL, FILL(pages)),
      .device = &(const struct rg_device){ .max_image_size = WILD, .max_layers = WILD },
      .text =
          "pages is too large; make it smaller: the device does not support images of this size" },
};

/* ---- rows ---- */

static const uint32_t words[] = { 0 };
static const struct rg_shader no_words = { .name = "no_words", .word_count = 8 };
static const struct rg_shader many_words = { "many_words", words, SIZE_MAX };

static const VkVertexInputAttributeDescription attributes[] = {
    { 0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0 },
    { 1, 0, VK_FORMAT_R32G32B32_SFLOAT, 12 },
};

static const VkVertexInputAttributeDescription same[] = {
    { 1, 0, VK_FORMAT_R32G32B32_SFLOAT, 0 },
    { 1, 0, VK_FORMAT_R32G32B32_SFLOAT, 12 },
};

#define DRAW_OTHER(...) DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }), __VA_ARGS__)
#define LAYOUT(...)     DRAW_OTHER(.vertices = &(const struct rg_vertex_layout){ __VA_ARGS__ })
#define ATTRIBUTE(...)  LAYOUT(24, 1, &(const VkVertexInputAttributeDescription){ __VA_ARGS__ })
#define BAD_ROW         "bad row 0 (draw): "
#define VERTICES \
    BAD_ROW NO_VALUE "vertices: expected a stride up to 2048, and attributes with the layout's " \
                     "binding, a colour format, an offset below 2048 and a unique location below " \
                     "16"

/* The second one has a location of the first; the third is a ring. */
static const struct rg_vertex_layout second = { 24, 1, &attributes[1] };
static const VkVertexInputAttributeDescription first_of_next = { 0, 1, COLOR_FORMAT, 0 };
static const struct rg_vertex_layout taken = { 24, 1, &first_of_next };
static const struct rg_vertex_layout ring = { .stride = 24, .next = &ring };

static const VkPipelineColorBlendAttachmentState plain_state = { .colorWriteMask = 0xf };
static const VkPipelineColorBlendAttachmentState wide_mask = { .colorWriteMask = 0x1f };
static const VkPipelineColorBlendAttachmentState second_source = { .srcColorBlendFactor =
                                                                       VK_BLEND_FACTOR_SRC1_COLOR };
static const VkPipelineColorBlendAttachmentState advanced = { .alphaBlendOp =
                                                                  VK_BLEND_OP_MULTIPLY_EXT };
#define BLENDED(...) DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER), __VA_ARGS__ }))
#define BLEND_STATE \
    BAD_ROW "other " NO_VALUE "blend_state: expected Vulkan constants without dual-source " \
            "blending, and no .blend"

static const struct rg_image marked = { "marked", .format = VK_FORMAT_D24_UNORM_S8_UINT };
static const struct rg_stencil writing = { .back = { .failOp = VK_STENCIL_OP_INVERT,
                                                     .writeMask = 1 } };
static const struct rg_stencil unknown = { .front = { .compareOp = (VkCompareOp)8 } };
static const struct rg_stencil sound = { 0 };

static const struct fault_case row_cases[] = {
    { ROW(RG_ERROR_VALUE, NULL,
          { .name = "draw",
            .kind = (enum rg_kind)7,
            .record = small_graph_record,
            .uses = RG_USES({ WRITE_OTHER }) }),
      .text = BAD_ROW NO_VALUE "kind: expected a constant of enum rg_kind" },
    { ROW(RG_ERROR_VALUE, NULL, DRAW_OTHER(.repeat = (enum rg_repeat)4)),
      .text = BAD_ROW NO_VALUE "repeat: expected a constant of enum rg_repeat" },
    { ROW(RG_ERROR_VALUE, NULL, DRAW_OTHER(.depth_compare = (VkCompareOp)99)),
      .text = BAD_ROW NO_VALUE "depth_compare: expected a constant of VkCompareOp" },
    { ROW(RG_ERROR_VALUE, NULL, DRAW_OTHER(.topology = VK_PRIMITIVE_TOPOLOGY_PATCH_LIST)),
      .text = BAD_ROW NO_VALUE
      "topology: expected a constant of VkPrimitiveTopology, up to TRIANGLE_FAN" },
    { ROW(RG_ERROR_VALUE, NULL, DRAW_OTHER(.cull = ~0U)),
      .text = BAD_ROW NO_VALUE "cull: expected a constant of VkCullModeFlagBits" },
    { ROW(RG_ERROR_VALUE, NULL, DRAW_OTHER(.front = (VkFrontFace)2)),
      .text = BAD_ROW NO_VALUE "front: expected a constant of VkFrontFace" },
    { ROW(RG_ERROR_TABLE, NULL, DRAW("draw", .color_count = 1, .depth = { CLEARED(flat) })),
      .text = BAD_ROW NO_TABLE "color: expected color_count entries, at most RG_COLOR_COUNT" },
    { ROW(RG_ERROR_TABLE, NULL,
          DRAW("draw", .color = &(const struct rg_target){ CLEARED(OTHER) }, .color_count = WILD)),
      .text = BAD_ROW NO_TABLE "color: expected color_count entries, at most RG_COLOR_COUNT" },
    { ROW(RG_ERROR_TABLE, NULL,
          { "draw", .vert = &small_graph_shader, .frag = &no_words, .record = small_graph_record,
            .color = RG_TARGETS({ CLEARED(OTHER) }) }),
      .text = BAD_ROW "no_words " NO_TABLE "words: expected word_count entries, at most "
                      "RG_MAX_ROWS" },
    { ROW(RG_ERROR_TABLE, NULL,
          { "draw", RG_COMPUTE, .comp = &many_words, .record = small_graph_record,
            .uses = RG_USES({ WRITE_OTHER }) }),
      .text = BAD_ROW "many_words " NO_TABLE "words: expected word_count entries, at most "
                      "RG_MAX_ROWS" },
    { ROW(RG_ERROR_TABLE, NULL, LAYOUT(24, 2, NULL)),
      .text = BAD_ROW NO_TABLE
      "attributes: expected attribute_count entries, at most RG_MAX_ATTRIBUTES" },
    { ROW(RG_ERROR_TABLE, NULL, LAYOUT(24, WILD, attributes)),
      .text = BAD_ROW NO_TABLE
      "attributes: expected attribute_count entries, at most RG_MAX_ATTRIBUTES" },
    { ROW(RG_ERROR_VALUE, NULL, LAYOUT(WILD, 2, attributes)), .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, LAYOUT(24, 2, same)), .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, ATTRIBUTE(WILD, 0, COLOR_FORMAT, 0)), .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, ATTRIBUTE(0, 1, COLOR_FORMAT, 0)), .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, ATTRIBUTE(0, 0, VK_FORMAT_UNDEFINED, 0)), .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, ATTRIBUTE(0, 0, (VkFormat)9999, 0)), .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, ATTRIBUTE(0, 0, COLOR_FORMAT, WILD)), .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, LAYOUT(24, 1, attributes, (VkVertexInputRate)2, NULL)),
      .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, LAYOUT(24, 1, attributes, .next = &second)), .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, LAYOUT(24, 1, attributes, .next = &taken)), .text = VERTICES },
    { ROW(RG_ERROR_VALUE, NULL, DRAW_OTHER(.vertices = &ring)),
      .text = BAD_ROW NO_VALUE "vertices: expected at most 8 layouts" },
    { ROW(RG_ERROR_VALUE, NULL, DRAW_OTHER(.depth_bias = { .slope = NAN })),
      .text = BAD_ROW NO_VALUE "depth_bias: expected finite numbers" },
    { ROW(RG_ERROR_NO_TARGET, NULL, DRAW_OTHER(.stencil = &sound)) },
    { ROW(RG_ERROR_FORMAT, NULL, DRAW("draw", .depth = { CLEARED(flat) }, .stencil = &sound)),
      .text = BAD_ROW "flat format does not support this use; a stencil test needs a format with a "
                      "stencil" },
    { ROW(RG_ERROR_VALUE, NULL, DRAW("draw", .depth = { CLEARED(marked) }, .stencil = &unknown)),
      .text = BAD_ROW NO_VALUE "stencil: expected Vulkan constants" },
    { .error = RG_ERROR_VALUE,
      .row = true,
      .row_count = 2,
      .rows = { DRAW("first", .depth = { CLEARED(marked) }),
                DRAW_OTHER(.depth = { &marked }, .stencil = &writing, .depth_read_only = true) },
      .text = "bad row 1 (draw): " NO_VALUE "stencil: expected no writes with depth_read_only" },
};

static const struct fault_case target_cases[] = {
    { ROW(RG_ERROR_VALUE, NULL, DRAW("draw", .color = RG_TARGETS({ &OTHER, (enum rg_load)77 }))),
      .text = BAD_ROW "other " NO_VALUE "load: expected a constant of enum rg_load" },
    { ROW(RG_ERROR_VALUE, NULL,
          DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER), .blend = (enum rg_blend)3 }))),
      .text = BAD_ROW "other " NO_VALUE "blend: expected a constant of enum rg_blend" },
    { ROW(RG_ERROR_VALUE, NULL, BLENDED(.blend_state = &wide_mask)), .text = BLEND_STATE },
    { ROW(RG_ERROR_VALUE, NULL, BLENDED(.blend_state = &second_source)), .text = BLEND_STATE },
    { ROW(RG_ERROR_VALUE, NULL, BLENDED(.blend_state = &advanced)), .text = BLEND_STATE },
    { ROW(RG_ERROR_VALUE, NULL, BLENDED(.blend_state = &plain_state, .blend = RG_BLEND_ADD)),
      .text = BLEND_STATE },
    { ROW(RG_ERROR_VALUE, NULL, DRAW("draw", .depth = { &flat, (enum rg_load)INT32_MAX })),
      .text = BAD_ROW "flat " NO_VALUE "load: expected a constant of enum rg_load" },
    { ROW(RG_ERROR_VALUE, NULL,
          DRAW("draw", .depth = { CLEARED(flat), .clear.depthStencil.depth = NAN })),
      .text = BAD_ROW "flat " NO_VALUE "clear: expected a depth from 0 to 1" },
};

#define BORROWED(of, ...) \
    DRAW_OTHER(.uses = RG_USES( \
                   { TEXTURE(of), .fallback = &(const struct rg_fallback){ { __VA_ARGS__ } } }))
#define FALLBACK(of) \
    BAD_ROW of " " NO_VALUE "fallback: expected finite numbers in the range of the format"

static const struct fault_case use_cases[] = {
    { ROW(RG_ERROR_VALUE, NULL,
          DRAW_OTHER(.uses =
                         RG_USES({ TEXTURE(PICTURE),
                                   .sampler = &(const struct rg_sampler){ .anisotropy = NAN } }))),
      .text = BAD_ROW "picture " NO_VALUE "sampler: expected an anisotropy of 0 or more" },
    { ROW(RG_ERROR_VALUE, NULL, BORROWED(PICTURE, 0, 0, 0, INFINITY)),
      .text = FALLBACK("picture") },
    { ROW(RG_ERROR_VALUE, NULL, BORROWED(numbers, 0, -1)), .text = FALLBACK("numbers") },
    { ROW(RG_ERROR_VALUE, NULL, BORROWED(numbers, 4294967296.0F)), .text = FALLBACK("numbers") },
    { ROW(RG_ERROR_VALUE, NULL, BORROWED(flat, 1.5F)), .text = FALLBACK("flat") },
    { ROW(RG_ERROR_RANGE, NULL,
          COPY("draw", { .buffer = &bytes, .access = RG_COPY_DST, .range.layer_count = 2 })),
      .text = BAD_ROW "bytes has no such mip, layer or aspect; range: expected {0}, since a pass "
                      "uses all of a buffer" },
    { AROUND(RG_ERROR_VALUE, NULL, COPY("copy", { .buffer = &nowhere, .access = RG_COPY_DST })),
      .text = "nowhere has an invalid value; memory: expected a constant of enum rg_memory" },
};

static void test_every_case(void **state)
{
    (void)state;
    const struct fault_cases tables[] = {
        FAULT_CASES(params_cases), FAULT_CASES(device_cases), FAULT_CASES(row_cases),
        FAULT_CASES(target_cases), FAULT_CASES(use_cases),
    };
    bool provoked[RG_ERROR_COUNT] = { false };
    fault_case_check(tables, sizeof(tables) / sizeof(tables[0]), provoked);
    for (int error = RG_ERROR_VALUE; error <= RG_ERROR_DEVICE; error++)
        assert_true(provoked[error]);
}

static void test_no_params(void **state)
{
    (void)state;
    struct rg_plan *plan = rg_compile(NULL);
    char text[256];
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 1);
    rg_fault_text(&plan->faults[0], text, sizeof(text));
    assert_string_equal(text, NO_TABLE "rg_compile(): expected params, got NULL");
    rg_plan_destroy(plan);
}

/* The last constants and the largest numbers are none of these. */
static void test_limits(void **state)
{
    (void)state;
    const struct fault_case fc = {
        .row_count = 1,
        .rows = { DRAW("draw", .color = RG_TARGETS({ CLEARED(OTHER) }),
                       .vertices = &(const struct rg_vertex_layout){ 2048, 2, attributes },
                       .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN,
                       .depth_compare = VK_COMPARE_OP_ALWAYS, .cull = VK_CULL_MODE_FRONT_AND_BACK,
                       .front = VK_FRONT_FACE_CLOCKWISE) },
    };
    struct rg_plan *plan = fault_case_compile(&fc);
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    rg_plan_destroy(plan);
}

/* ---- executors ---- */

static PFN_vkVoidFunction find_nothing(VkInstance instance, const char *name)
{
    (void)instance;
    (void)name;
    return NULL;
}

static void note(void *user, const char *what, VkResult result)
{
    snprintf(user, 128, "%s: %d", what, (int)result);
}

/* Nothing of Vulkan is called; what is missing is told. */
static void test_executors(void **state)
{
    (void)state;
    static const struct rg_plan faulty = { .fault_count = 1 };
    static const struct rg_plan good = { 0 };
    static const VkSpecializationMapEntry entry = { 0, 4, 4 };
    const VkSpecializationInfo constants[] = {
        { 1, NULL, 4, "1234" },
        { 1, &entry, 4, NULL },
        { 1, &entry, 7, "1234567" },
    };

    const struct {
        struct rg_exec_params params;
        const char *text;
    } cases[] = {
        { { .get_proc_addr = find_nothing }, "params without a plan free of faults" },
        { { .plan = &faulty, .get_proc_addr = find_nothing }, "params without a plan free" },
        { { .plan = &good }, "or without get_proc_addr" },
        { { .plan = &good, .get_proc_addr = find_nothing, .import_count = 1 }, "no imports" },
        { { .plan = &good,
            .get_proc_addr = find_nothing,
            .imports = &(const struct rg_exec_import){ .image_count = 2 },
            .import_count = 1 },
          "no images" },
        { { .plan = &good, .get_proc_addr = find_nothing, .constants = &constants[0] },
          "entries or data are NULL" },
        { { .plan = &good, .get_proc_addr = find_nothing, .constants = &constants[1] },
          "entries or data are NULL" },
        { { .plan = &good, .get_proc_addr = find_nothing, .constants = &constants[2] },
          "exceeds its data" },
        { { .plan = &good, .get_proc_addr = find_nothing }, "params without an instance, a" },
    };

    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char text[128] = "";
        struct rg_exec_params params = cases[i].params;
        VkResult result;
        params.log = note;
        params.user = text;
        assert_null(rg_exec_create(&params, &result));
        assert_int_equal(result, VK_ERROR_INITIALIZATION_FAILED);
        assert_non_null(strstr(text, cases[i].text));
    }
    assert_null(rg_exec_create(NULL, NULL));
    assert_null(rg_exec_device(&(struct rg_vulkan){ .get_proc_addr = find_nothing }).image_memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_case),
        cmocka_unit_test(test_no_params),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_executors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
