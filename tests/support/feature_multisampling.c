/* feature_multisampling.c: feature graphs of multisampled targets, four samples per pixel. */
#include "tests/support/feature_graphs.h"

#define SAMPLES_IMAGE(...) COLOR_IMAGE(__VA_ARGS__, .samples = 4)
#define TRIANGLE_BY(record_function) \
    .vert = &triangle_vert, .frag = &paint_frag, .push_size = sizeof(struct paint_push), \
    .record = (record_function)
#define EIGHTS .clear.color = { { 8, 8, 8, 8 } }

static const struct rg_image samples = SAMPLES_IMAGE("samples");

static const struct rg_image samples_depth = {
    .name = "samples of depth",
    .format = VK_FORMAT_D32_SFLOAT,
    .samples = 4,
};

/* ---- resolved ---- */

static const struct rg_image triangle = COLOR_IMAGE("triangle");
static const struct rg_buffer triangle_out = COLOR_BUFFER("triangle out");

static const struct rg_image other_samples = SAMPLES_IMAGE("samples of other", .scale = 0.5F);
static const struct rg_image part_samples = SAMPLES_IMAGE("samples of part", .scale = 0.5F);
const struct rg_image feature_resolve_part = COLOR_IMAGE("part", .layers = 2, .mips = 2);
static const struct rg_buffer part_out = {
    .name = "part out",
    .size = sizeof(vec4s) * 2 * FEATURE_TEXELS / 4,
    .memory = RG_MEMORY_READBACK,
};

static const struct rg_image layers_samples =
    SAMPLES_IMAGE("samples of layers", .layers = RESOLVE_LAYER_COUNT);
const struct rg_image feature_resolve_layers = COLOR_IMAGE("layers", .layers = RESOLVE_LAYER_COUNT);
static const struct rg_buffer layers_out = {
    .name = "layers out",
    .size = sizeof(vec4s) * RESOLVE_LAYER_COUNT * FEATURE_TEXELS,
    .memory = RG_MEMORY_READBACK,
};

/* the first of two targets is neither resolved nor read */
static const struct rg_image first_samples = SAMPLES_IMAGE("samples of first");
static const struct rg_image second_samples = SAMPLES_IMAGE("samples of second");
static const struct rg_image second = COLOR_IMAGE("second");
static const struct rg_buffer second_out = COLOR_BUFFER("second out");

static const struct rg_image kept_samples = SAMPLES_IMAGE("samples of kept", .persistent = true);
static const struct rg_image kept = COLOR_IMAGE("kept");
static const struct rg_buffer kept_out = COLOR_BUFFER("kept out");

static const struct rg_image numbers_samples = {
    .name = "samples of numbers",
    .format = VK_FORMAT_R32_UINT,
    .samples = 4,
};
static const struct rg_image numbers = { .name = "numbers", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer numbers_out = FEATURE_NUMBERS("numbers out");

static const struct rg_pass resolve_rows[] = {
    [RESOLVE_TRIANGLE] = {
        .name = "triangle",
        .color = RG_TARGETS({ &samples, RG_LOAD_CLEAR, EIGHTS, .resolve = &triangle }),
        .depth = { &samples_depth, RG_LOAD_CLEAR, .clear.depthStencil.depth = 0.5F },
        TRIANGLE_BY(painted_record),
    },
    [RESOLVE_OTHER] = {
        .name = "other",
        .color = RG_TARGETS({ &other_samples, RG_LOAD_CLEAR, EIGHTS,
                              .resolve = &feature_resolve_part,
                              .resolve_mip = 1, .resolve_layer = 1 }),
        TRIANGLE_BY(painted_record),
    },
    [RESOLVE_PART] = {
        .name = "part",
        .color = RG_TARGETS({ &part_samples, RG_LOAD_CLEAR, EIGHTS,
                              .resolve = &feature_resolve_part, .resolve_mip = 1 }),
        TRIANGLE_BY(painted_record),
    },
    [RESOLVE_LAYERS] = {
        .name = "layers",
        .repeat = RG_PER_LAYER,
        .color = RG_TARGETS({ &layers_samples, RG_LOAD_CLEAR, EIGHTS,
                              .resolve = &feature_resolve_layers }),
        TRIANGLE_BY(painted_record_number),
    },
    [RESOLVE_TWO] = {
        .name = "two",
        .color = RG_TARGETS({ &first_samples, RG_LOAD_DISCARD },
                            { &second_samples, RG_LOAD_DISCARD, .resolve = &second }),
        PAINTED_BY(painted_record, &paint_two_frag),
    },
    [RESOLVE_KEEP] = {
        .name = "keep",
        .color = RG_TARGETS({ &kept_samples, RG_LOAD_KEEP, .blend = RG_BLEND_ADD,
                              .resolve = &kept }),
        TRIANGLE_BY(painted_record),
    },
    [RESOLVE_NUMBERS] = {
        .name = "numbers",
        .color = RG_TARGETS({ &numbers_samples, RG_LOAD_CLEAR, .clear.color.uint32 = { 1000 },
                              .resolve = &numbers }),
        PAINTED_BY(painted_record, &sample_zero_frag),
    },
    RUN_READ("read triangle", triangle, triangle_out),
    RUN_READ_PART("read part", feature_resolve_part, part_out, .mip = 1),
    RUN_READ("read layers", feature_resolve_layers, layers_out),
    RUN_READ("read second", second, second_out),
    RUN_READ("read kept", kept, kept_out),
    RUN_READ("read numbers", numbers, numbers_out),
};

const struct feature feature_resolve = {
    .name = "feature_resolve",
    .params = {
        .technique = RG_TECHNIQUE("resolve", resolve_rows),
        .outputs = {
            [RESOLVE_TRIANGLE_OUT] = &triangle_out,
            [RESOLVE_PART_OUT] = &part_out,
            [RESOLVE_LAYERS_OUT] = &layers_out,
            [RESOLVE_SECOND_OUT] = &second_out,
            [RESOLVE_KEPT_OUT] = &kept_out,
            [RESOLVE_NUMBERS_OUT] = &numbers_out,
        },
    },
};

/* ---- fetch of single samples ---- */

static const struct rg_image color_sum = COLOR_IMAGE("sum of color");
static const struct rg_image depth_sum = COLOR_IMAGE("sum of depth");
static const struct rg_buffer color_sum_out = COLOR_BUFFER("color out");
static const struct rg_buffer depth_sum_out = COLOR_BUFFER("depth out");

#define WEIGH(title, from, to) \
    { \
        .name = (title), .color = RG_TARGETS({ &(to), RG_LOAD_DISCARD }), \
        .uses = RG_USES(PAINTED_SOURCE(from)), .vert = &triangle_vert, \
        .frag = &fetch_samples_frag, .push_size = sizeof(struct paint_push), \
        .record = record_screen, \
    }

/* Draws one triangle that covers the whole view. */
static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    painted_draw(cmd, &(struct paint_push){ .from = { { -1, -1 } }, .to = { { 3, 3 } } });
}

static const struct rg_pass sample_rows[] = {
    [SAMPLES_TRIANGLE] = {
        .name = "triangle",
        .color = RG_TARGETS({ &samples, RG_LOAD_CLEAR, EIGHTS }),
        .depth = { &samples_depth, RG_LOAD_CLEAR, .clear.depthStencil.depth = 0.5F },
        TRIANGLE_BY(painted_record),
    },
    WEIGH("weigh color", samples, color_sum),
    WEIGH("weigh depth", samples_depth, depth_sum),
    RUN_READ("read color", color_sum, color_sum_out),
    RUN_READ("read depth", depth_sum, depth_sum_out),
};

const struct feature feature_samples = {
    .name = "feature_samples",
    .params = {
        .technique = RG_TECHNIQUE("samples", sample_rows),
        .outputs = {
            [SAMPLES_COLOR_OUT] = &color_sum_out,
            [SAMPLES_DEPTH_OUT] = &depth_sum_out,
        },
    },
};
