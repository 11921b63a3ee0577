/* test_exec_fallback.c: what shaders sample where nothing provides an image. */
#include "tests/support/assertions.h"

#include "tests/gpu/shaders/data.h"
#include "tests/support/lavapipe.h"
#include "tests/support/rectangle_rows.h"

enum {
    SAMPLED_COUNT = 6,
};

static const struct rg_image flat = COLOR_IMAGE("flat");
static const struct rg_image array = COLOR_IMAGE("array", .array = true);
static const struct rg_image cube = COLOR_IMAGE("cube", .width = 4, .height = 4, .cube = true);
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_image numbers = { .name = "numbers", .format = VK_FORMAT_R32G32B32A32_UINT };
static const struct rg_image drawn = COLOR_IMAGE("drawn");
static const struct rg_buffer sampled_out = {
    .name = "sampled out",
    .size = SAMPLED_COUNT * sizeof(vec4s),
    .memory = RG_MEMORY_READBACK,
};
static const struct rg_buffer drawn_out = COLOR_BUFFER("drawn out");

static const struct rg_fallback colors = { { 0.25f, 0.5f, 0.75f, 1 } };
static const struct rg_fallback layer = { { 1, 2, 3, 4 } };
static const struct rg_fallback sky = { { 5, 6, 7, 8 } };
static const struct rg_fallback far_away = { { 0.125f, 9, 9, 9 } };
static const struct rg_fallback counts = { { 11, 12, 13, 14 } };

static const struct rg_sampler linear = { .linear = true, .mips = true };

static void record_once(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, 1, 1, 1);
}

#define FALL_BACK(number, from, content) \
    { \
        .image = &(from), .access = RG_SAMPLED, .binding = DATA_SAMPLERS + (number), \
        .fallback = &(content) \
    }

/* The first row also draws from a fallback, plus what its paint adds. */
static const struct rg_pass rows[] = {
    {
        .name = "draw",
        .color = RG_TARGETS({ &drawn, RG_LOAD_CLEAR }),
        .uses = RG_USES(
            { .image = &array, .access = RG_SAMPLED, .binding = PAINT_SOURCE, .fallback = &layer }),
        .vert = &paint_vert,
        .frag = &fetch_layer_frag,
        .push_size = sizeof(struct paint_push),
        .record = painted_record,
    },
    {
        .name = "sample",
        .kind = RG_COMPUTE,
        .uses = RG_USES(
            { .image = &flat,
              .access = RG_SAMPLED,
              .binding = DATA_SAMPLERS,
              .sampler = &linear,
              .fallback = &colors },
            FALL_BACK(1, array, layer), FALL_BACK(2, cube, sky), FALL_BACK(3, depth, far_away),
            FALL_BACK(4, numbers, counts), FALL_BACK(5, flat, colors),
            { .buffer = &sampled_out, .access = RG_STORAGE_WRITE, .binding = DATA_COLORS }),
        .comp = &fallbacks_comp,
        .record = record_once,
    },
    RUN_READ("read", drawn, drawn_out),
};

/* One texel lies at (0, 0): the paint is there alone. */
static const struct paint_push paints[] = {
    { .color = { { 100, 0, 0, 0 } }, .from = { { -1, -1 } }, .to = { { -0.75f, -0.75f } } },
};

static void check(struct run *run)
{
    painted_check(run, &sampled_out, 0, painted_color(0.25f, 0.5f, 0.75f, 1));
    painted_check(run, &sampled_out, 1, painted_color(1, 2, 3, 4));
    painted_check(run, &sampled_out, 2, painted_color(5, 6, 7, 8));
    painted_check(run, &sampled_out, 3, painted_color(0.125f, 0, 0, 1));
    painted_check(run, &sampled_out, 4, painted_color(11, 12, 13, 14));
    painted_check(run, &sampled_out, 5, painted_color(0.25f, 0.5f, 0.75f, 1));
    painted_check(run, &drawn_out, 0, painted_color(101, 2, 3, 4));
}

static void fallbacks_are_sampled(void **state)
{
    PAINTED_VARIANTS(state, rows, paints, check, .outputs = { &sampled_out, &drawn_out });
}

/* The content is written once, before the first of several frames. */
static void the_second_frame_samples_them_too(void **state)
{
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", rows),
        .outputs = { &sampled_out, &drawn_out },
        .frames_in_flight = 2,
    };
    const struct rg_frame frame = { .rows = rows, .paints = paints };
    struct run run;
    run_open(&run, *state, &params);
    for (uint32_t i = 0; i < 3; i++) {
        run_frame(&run, &frame);
        check(&run);
    }
    run_close(&run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(fallbacks_are_sampled),
        ON_DEVICE(the_second_frame_samples_them_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
