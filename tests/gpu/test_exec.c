/* test_exec.c: what raster passes of the executor draw, to the bit. */
#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"
#include "tests/support/rectangle_rows.h"

static void record_extent(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    const VkExtent2D extent = rg_cmd_extent(cmd);
    painted_draw(cmd, &(struct paint_push){
                          .color = { { (float)extent.width, (float)extent.height, 0, 1 } },
                          ALL,
                      });
}

/* ---- loads, several targets ---- */

static const struct rg_image load_color = COLOR_IMAGE("color");
static const struct rg_image load_first = COLOR_IMAGE("first");
static const struct rg_image load_second = COLOR_IMAGE("second");
static const struct rg_buffer load_color_out = COLOR_BUFFER("color out");
static const struct rg_buffer load_first_out = COLOR_BUFFER("first out");
static const struct rg_buffer load_second_out = COLOR_BUFFER("second out");

static const struct rg_pass load_rows[] = {
    {
        .name = "clear",
        .color = RG_TARGETS(
            { &load_color, RG_LOAD_CLEAR, .clear.color = { { 0.25F, 0.5F, 0.75F, 1 } } }),
        PAINTED,
    },
    { .name = "keep", .color = RG_TARGETS({ &load_color, RG_LOAD_KEEP }), PAINTED },
    {
        .name = "discard",
        .color = RG_TARGETS({ &load_first, RG_LOAD_DISCARD }, { &load_second, RG_LOAD_DISCARD }),
        PAINTED_BY(painted_record, &paint_two_frag),
    },
    RUN_READ("read color", load_color, load_color_out),
    RUN_READ("read first", load_first, load_first_out),
    RUN_READ("read second", load_second, load_second_out),
};

static void check_loads(struct run *run)
{
    for (uint32_t i = 0; i < 64; i++) {
        const bool top = i / 8 < 4;
        const bool left = i % 8 < 4;
        painted_check(run, &load_color_out, i,
                      top    ? painted_color(6, 7, 8, 9)
                      : left ? painted_color(2, 3, 4, 5)
                             : painted_color(0.25F, 0.5F, 0.75F, 1));
    }
    painted_check_all(run, &load_first_out, 64, painted_color(1, 2, 3, 4));
    painted_check_all(run, &load_second_out, 64, painted_color(4, 3, 2, 1));
}

static void loads_and_targets(void **state)
{
    static const struct paint_push paints[] = {
        { .color = { { 2, 3, 4, 5 } }, LEFT_HALF },
        { .color = { { 6, 7, 8, 9 } }, TOP_HALF },
        { .color = { { 1, 2, 3, 4 } }, ALL },
    };
    PAINTED_VARIANTS(state, load_rows, paints, check_loads,
                     .outputs = { &load_color_out, &load_first_out, &load_second_out });
}

/* ---- rows repeated by layer and by mip ---- */

static void check_cube(struct run *run)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    for (uint32_t i = 0; i < 6 * 9; i++) {
        const uint32_t face = i / 9;
        const float number = (float)(face + 1);
        const bool painted = i % 3 < 2;
        painted_check(run, outputs[PER_LAYER_CUBE_OUT], i,
                      painted ? painted_color(number, 0, 0, 1) : painted_color(7, 7, 7, 7));
        painted_check(run, outputs[PER_LAYER_COPY_OUT], i,
                      painted ? painted_color(number, 0, 0, 101) : painted_color(7, 7, 7, 107));
    }
    for (uint32_t face = 0; face < 6; face++)
        painted_check(run, outputs[PER_LAYER_SEEN_OUT], face,
                      painted_color((float)(face + 1), 0, 0, 1));
}

static void row_per_layer(void **state)
{
    static const struct paint_push paints[] = {
        { .color = { { 0, 0, 0, 1 } }, .from = { { -1, -1 } }, .to = { { 1 / 3.0F, 1 } } },
        { .color = { { 0, 0, 0, 100 } }, ALL },
    };
    const struct run_params *params = &feature_per_layer.params;
    run_variants(*state, params,
                 &(struct rg_frame){ .rows = params->technique.passes, .paints = paints },
                 check_cube);
}

static void check_mips(struct run *run)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    painted_check_all(run, outputs[PER_MIP_FROM_2_OUT], 2 * 2, painted_color(3, 0, 0, 1));
    painted_check_all(run, outputs[PER_MIP_FROM_3_OUT], 1, painted_color(4, 0, 0, 1));
    painted_check_all(run, outputs[PER_MIP_TO_0_OUT], 4 * 4, painted_color(2, 100, 0, 1));
    painted_check_all(run, outputs[PER_MIP_TO_1_OUT], 2 * 2, painted_color(3, 100, 0, 1));
}

static void row_per_mip(void **state)
{
    static const struct paint_push paints[] = {
        { .color = { { 0, 0, 0, 1 } }, ALL },
        { .color = { { 0, 100, 0, 0 } }, ALL },
    };
    const struct run_params *params = &feature_per_mip.params;
    run_variants(*state, params,
                 &(struct rg_frame){ .rows = params->technique.passes, .paints = paints },
                 check_mips);
}

enum {
    CHAIN_WIDTH = 16,
    CHAIN_HEIGHT = 6,
    CHAIN_MIPS = 5, /* 16 x 6, 8 x 3, 4 x 1, 2 x 1, 1 x 1 */
};

static const struct rg_image chain = COLOR_IMAGE("chain", .mips = RG_ALL_MIPS);
static const struct rg_buffer chain_out[CHAIN_MIPS] = {
    COLOR_BUFFER("out 0"), COLOR_BUFFER("out 1"), COLOR_BUFFER("out 2"),
    COLOR_BUFFER("out 3"), COLOR_BUFFER("out 4"),
};

static void check_chain(struct run *run)
{
    uint32_t width = CHAIN_WIDTH;
    uint32_t height = CHAIN_HEIGHT;
    for (uint32_t i = 0; i < width * height; i++) {
        const uint32_t row = i / width;
        const float x = (float)(i % width);
        const float y = (float)row;
        painted_check(run, &chain_out[0], i, painted_color(x, y, x * y, 1));
    }
    for (uint32_t mip = 1; mip < CHAIN_MIPS; mip++) {
        const vec4s *above = run_data(run, &chain_out[mip - 1]);
        const uint32_t row = width;
        const uint32_t last = height - 1;
        width /= 2;
        height = height > 1 ? height / 2 : 1;
        for (uint32_t i = 0; i < width * height; i++) {
            const uint32_t y = i / width * 2;
            const vec4s *top = &above[y * row + i % width * 2];
            const vec4s *low = top + (y < last ? row : 0);
            vec4s sum = { { 0 } };
            for (size_t c = 0; c < 4; c++)
                sum.raw[c] = (top[0].raw[c] + top[1].raw[c] + low[0].raw[c] + low[1].raw[c]) / 4;
            painted_check(run, &chain_out[mip], i, sum);
        }
    }
}

/* Each mip is made from the one above it, by rows filled in at run time. */
static void mips_from_mips(void **state)
{
    static const char *const names[] = { "0", "1", "2", "3", "4", "5", "6", "7", "8", "9" };
    struct rg_use uses[CHAIN_MIPS][2] = { 0 };
    struct rg_use reads[CHAIN_MIPS][3] = { 0 };
    struct rg_pass rows[2 * CHAIN_MIPS] = { 0 };
    struct rg_target targets[CHAIN_MIPS];
    struct paint_push paints[CHAIN_MIPS];
    for (uint32_t i = 0; i < CHAIN_MIPS; i++) {
        paints[i] = (struct paint_push){ ALL };
        targets[i] = (struct rg_target){ &chain, RG_LOAD_DISCARD, .mip = i };
        uses[i][0] = (struct rg_use){
            .image = &chain,
            .access = RG_SAMPLED,
            .binding = PAINT_SOURCE,
            .range = { .mip = i - 1, .mip_count = 1 },
        };
        rows[i] = (struct rg_pass){
            .name = names[i],
            .color = &targets[i],
            .color_count = 1,
            .uses = i ? uses[i] : NULL,
            PAINTED_BY(painted_record, i ? &halve_frag : &pattern_frag),
        };
        reads[i][0] = (struct rg_use){ &chain, .access = RG_COPY_SRC, .range.mip = i };
        reads[i][1] = (struct rg_use){ .buffer = &chain_out[i], .access = RG_COPY_DST };
        rows[CHAIN_MIPS + i] = (struct rg_pass){
            .name = names[CHAIN_MIPS + i],
            .kind = RG_TRANSFER,
            .uses = reads[i],
            .record = run_record_read,
        };
    }
    PAINTED_VARIANTS(
        state, rows, paints, check_chain, .view = { CHAIN_WIDTH, CHAIN_HEIGHT },
        .outputs = { &chain_out[0], &chain_out[1], &chain_out[2], &chain_out[3], &chain_out[4] });
}

/* ---- sizes ---- */

static const struct rg_image size_images[] = {
    COLOR_IMAGE("view"),
    COLOR_IMAGE("half", .scale = 0.5F),
    COLOR_IMAGE("tiny", .scale = 0.01F),
    COLOR_IMAGE("fixed", .width = 3, .height = 2, .scale = 9),
};
static const struct rg_buffer size_out[] = {
    COLOR_BUFFER("view out"),
    COLOR_BUFFER("half out"),
    COLOR_BUFFER("tiny out"),
    COLOR_BUFFER("fixed out"),
};

#define SIZE_ROWS(title, index) \
    { \
        .name = (title), \
        .color = RG_TARGETS({ &size_images[index], RG_LOAD_DISCARD }), \
        PAINTED_BY(record_extent, &paint_frag), \
    }, \
        RUN_READ("read " title, size_images[index], size_out[index])

static const struct rg_pass size_rows[] = {
    SIZE_ROWS("view", 0),
    SIZE_ROWS("half", 1),
    SIZE_ROWS("tiny", 2),
    SIZE_ROWS("fixed", 3),
};

static void check_sizes(struct run *run)
{
    painted_check_all(run, &size_out[0], 13 * 7, painted_color(13, 7, 0, 1));
    painted_check_all(run, &size_out[1], 7 * 4, painted_color(7, 4, 0, 1));
    painted_check_all(run, &size_out[2], 1, painted_color(1, 1, 0, 1));
    painted_check_all(run, &size_out[3], 3 * 2, painted_color(3, 2, 0, 1));
}

static void sizes_follow_the_view(void **state)
{
    PAINTED_VARIANTS(state, size_rows, NULL, check_sizes, .view = { 13, 7 },
                     .outputs = { &size_out[0], &size_out[1], &size_out[2], &size_out[3] });
}

/* ---- memory ---- */

static const struct rg_image links[] = {
    COLOR_IMAGE("link 0"),
    COLOR_IMAGE("link 1"),
    COLOR_IMAGE("link 2"),
    COLOR_IMAGE("link 3"),
};
static const struct rg_buffer links_out = COLOR_BUFFER("out");

#define LINK(title, from, to) \
    { \
        .name = (title), .color = RG_TARGETS({ &links[to], RG_LOAD_DISCARD }), \
        .uses = RG_USES({ \
            .image = &links[from], \
            .access = RG_SAMPLED, \
            .binding = PAINT_SOURCE, \
        }), \
        PAINTED_BY(painted_record, &fetch_frag) \
    }

static const struct rg_pass link_rows[] = {
    { .name = "first", .color = RG_TARGETS({ &links[0], RG_LOAD_DISCARD }), PAINTED },
    LINK("second", 0, 1),
    LINK("third", 1, 2),
    LINK("fourth", 2, 3),
    RUN_READ("read", links[3], links_out),
};

static void check_links(struct run *run)
{
    painted_check_all(run, &links_out, 64, painted_color(1111, 2222, 3333, 4444));
    if (run->params.sharing == RG_SHARE_NOTHING)
        assert_true(run->plan->memory_used == run->plan->memory_without_aliasing);
    else
        assert_true(run->plan->memory_used == run->plan->memory_without_aliasing / 2);
}

static const struct paint_push link_paints[] = {
    { .color = { { 1, 2, 3, 4 } }, ALL },
    { .color = { { 10, 20, 30, 40 } }, ALL },
    { .color = { { 100, 200, 300, 400 } }, ALL },
    { .color = { { 1000, 2000, 3000, 4000 } }, ALL },
};

static void memory_is_shared(void **state)
{
    PAINTED_VARIANTS(state, link_rows, link_paints, check_links, .outputs = { &links_out });
}

/* The second link lives longer than the neighbours, of which the later ones must not touch it. */
static const struct rg_buffer second_out = COLOR_BUFFER("second out");
static const struct rg_pass neighbour_rows[] = {
    { .name = "first", .color = RG_TARGETS({ &links[0], RG_LOAD_DISCARD }), PAINTED },
    LINK("second", 0, 1),
    LINK("third", 1, 2),
    LINK("fourth", 2, 3),
    RUN_READ("read second", links[1], second_out),
    RUN_READ("read", links[3], links_out),
};

enum {
    SIDE = 128, /* an image of it fills many pages of memory */
};

static void check_neighbours(struct run *run)
{
    painted_check_all(run, &second_out, SIDE * SIDE, painted_color(11, 22, 33, 44));
    painted_check_all(run, &links_out, SIDE * SIDE, painted_color(1111, 2222, 3333, 4444));
    if (run->params.sharing != RG_SHARE_NOTHING)
        assert_true(run->plan->memory_used == run->plan->memory_without_aliasing / 4 * 3);
}

static void large_images_share_memory(void **state)
{
    PAINTED_VARIANTS(state, neighbour_rows, link_paints, check_neighbours,
                     .outputs = { &links_out, &second_out }, .view = { SIDE, SIDE });
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(loads_and_targets),
        ON_DEVICE(row_per_layer),
        ON_DEVICE(row_per_mip),
        ON_DEVICE(mips_from_mips),
        ON_DEVICE(sizes_follow_the_view),
        ON_DEVICE(memory_is_shared),
        ON_DEVICE(large_images_share_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
