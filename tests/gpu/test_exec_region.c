/* test_exec_region.c: a region of the view drawn alone, and where its fragments look. */
#include "tests/support/assertions.h"

#include "tests/support/lavapipe.h"
#include "tests/support/rectangle_rows.h"

static const struct rg_image under = COLOR_IMAGE("under");
static const struct rg_image map = COLOR_IMAGE("map");
static const struct rg_image own = COLOR_IMAGE("own");
static const struct rg_image mixed = COLOR_IMAGE("mixed");
static const struct rg_image fixed = COLOR_IMAGE("fixed", .width = 8, .height = 8);
static const struct rg_image history = COLOR_IMAGE("history", .persistent = true);
static const struct rg_image depth = { .name = "depth", .format = VK_FORMAT_D32_SFLOAT };
static const struct rg_image seen_map = COLOR_IMAGE("seen map");
static const struct rg_image seen_own = COLOR_IMAGE("seen own");
static const struct rg_image seen_mixed = COLOR_IMAGE("seen mixed");
static const struct rg_image seen_fixed = COLOR_IMAGE("seen fixed");
static const struct rg_image seen_history = COLOR_IMAGE("seen history");
static const struct rg_buffer map_out = COLOR_BUFFER("map out");
static const struct rg_buffer own_out = COLOR_BUFFER("own out");
static const struct rg_buffer mixed_out = COLOR_BUFFER("mixed out");
static const struct rg_buffer mixed_seen_out = COLOR_BUFFER("mixed seen out");
static const struct rg_buffer fixed_out = COLOR_BUFFER("fixed out");
static const struct rg_buffer history_out = COLOR_BUFFER("history out");

static const struct rg_sampler same_texel = { 0 };

#define CLEAR(target) \
    .color = RG_TARGETS({ &(target), RG_LOAD_CLEAR, .clear.color = { { 1, 2, 3, 4 } } })
#define HERE(from) \
    { \
        .image = &(from), .access = RG_SAMPLED, .binding = PAINT_SOURCE, .sampler = &same_texel \
    }
#define FETCHED PAINTED_BY(painted_record, &fetch_frag)

static const struct rg_pass rows[] = {
    { .name = "under", CLEAR(under), PAINTED },
    {
        .name = "map", /* it has to draw `depth` for later rows, but they not for it */
        CLEAR(map),
        .depth = { &depth, RG_LOAD_CLEAR },
        .uses = RG_USES(HERE(under)),
        FETCHED,
    },
    { .name = "own", CLEAR(own), .depth = { &depth, RG_LOAD_CLEAR }, PAINTED },
    { .name = "mixed", CLEAR(mixed), PAINTED },
    { .name = "fixed", CLEAR(fixed), PAINTED },
    { .name = "history", CLEAR(history), PAINTED },
    { .name = "see map", CLEAR(seen_map), .uses = RG_USES(PAINTED_SOURCE(map)), FETCHED },
    {
        .name = "see own",
        CLEAR(seen_own),
        .depth = { &depth, RG_LOAD_KEEP },
        .depth_read_only = true,
        .depth_compare = VK_COMPARE_OP_ALWAYS,
        .uses = RG_USES(HERE(own)),
        FETCHED,
    },
    { .name = "see mixed", CLEAR(seen_mixed), .uses = RG_USES(PAINTED_SOURCE(mixed)), FETCHED },
    { .name = "see fixed", CLEAR(seen_fixed), .uses = RG_USES(HERE(fixed)), FETCHED },
    { .name = "see history", CLEAR(seen_history), .uses = RG_USES(HERE(history)), FETCHED },
    RUN_READ("read map", seen_map, map_out),
    RUN_READ("read own", seen_own, own_out),
    RUN_READ("read mixed", mixed, mixed_out),
    RUN_READ("read seen mixed", seen_mixed, mixed_seen_out),
    RUN_READ("read fixed", seen_fixed, fixed_out),
    RUN_READ("read history", seen_history, history_out),
};

/* All are the same: five and so on in the left half, the clear value in the right one. */
#define HALF \
    { \
        .color = { { 5, 6, 7, 8 } }, LEFT_HALF \
    }
#define COPY \
    { \
        ALL \
    }
static const struct paint_push paints[] = {
    HALF, COPY, HALF, HALF, HALF, HALF, COPY, COPY, COPY, COPY, COPY,
};

/* What the rows draw, in their order. */
#define WHOLE \
    { \
        { 0, 0 }, \
        { \
            8, 8 \
        } \
    }
#define PART \
    { \
        { 2, 4 }, \
        { \
            4, 3 \
        } \
    }
#define REACH \
    { \
        { 0, 2 }, \
        { \
            5, 4 \
        } \
    }
#define BOTH \
    { \
        { 0, 2 }, \
        { \
            6, 5 \
        } \
    }
static const struct rg_exec_region wanted = { PART, REACH };
static const VkRect2D areas[] = {
    BOTH, BOTH, PART, BOTH, WHOLE, WHOLE, PART, PART, PART, PART, PART,
};

enum {
    AREA_COUNT = sizeof(areas) / sizeof(areas[0])
};

static struct {
    PFN_vkCmdSetScissor set_scissor;
    PFN_vkCmdBeginRendering begin_rendering;
    PFN_vkCmdBeginRenderPass begin_render_pass;
    VkRect2D rendered; /* of the pass that has begun */
    VkRect2D areas[AREA_COUNT];
    uint32_t count;
    uint32_t begun; /* passes */
} noted;

static VKAPI_ATTR void VKAPI_CALL note_scissor(VkCommandBuffer commands, uint32_t first,
                                               uint32_t count, const VkRect2D *scissors)
{
    assert_true(noted.count < AREA_COUNT);
    assert_memory_equal(scissors, &noted.rendered, sizeof(*scissors));
    noted.areas[noted.count++] = *scissors;
    noted.set_scissor(commands, first, count, scissors);
}

static VKAPI_ATTR void VKAPI_CALL note_rendering(VkCommandBuffer commands,
                                                 const VkRenderingInfo *info)
{
    noted.rendered = info->renderArea;
    noted.begun++;
    noted.begin_rendering(commands, info);
}

static VKAPI_ATTR void VKAPI_CALL note_render_pass(VkCommandBuffer commands,
                                                   const VkRenderPassBeginInfo *info,
                                                   VkSubpassContents contents)
{
    noted.rendered = info->renderArea;
    noted.begun++;
    noted.begin_render_pass(commands, info, contents);
}

static void open_noted(struct run *run, struct gpu *gpu, const struct run_params *params)
{
    noted.set_scissor = vkCmdSetScissor;
    noted.begin_rendering = vkCmdBeginRendering;
    noted.begin_render_pass = vkCmdBeginRenderPass;
    vkCmdSetScissor = note_scissor;
    vkCmdBeginRendering = note_rendering;
    vkCmdBeginRenderPass = note_render_pass;
    struct run_params noted_params = *params;
    noted_params.same_texel = &same_texel;
    run_open(run, gpu, &noted_params);
    vkCmdSetScissor = noted.set_scissor;
    vkCmdBeginRendering = noted.begin_rendering;
    vkCmdBeginRenderPass = noted.begin_render_pass;
}

static bool is_inside(VkRect2D area, uint32_t x, uint32_t y)
{
    const uint32_t left = (uint32_t)area.offset.x, top = (uint32_t)area.offset.y;
    return x >= left && x < left + area.extent.width && y >= top && y < top + area.extent.height;
}

/* The texels of an area, rows tight; those of the map only where it was drawn. */
static void check_texels(struct run *run, VkRect2D area, VkRect2D map_area)
{
    for (size_t o = 0; run->params.outputs[o]; o++) {
        const struct rg_buffer *out = run->params.outputs[o];
        for (uint32_t i = 0; i < area.extent.width * area.extent.height; i++) {
            const uint32_t x = (uint32_t)area.offset.x + i % area.extent.width;
            const uint32_t y = (uint32_t)area.offset.y + i / area.extent.width;
            if (out != &map_out || is_inside(map_area, x, y))
                painted_check(run, out, i,
                              x < 4 ? painted_color(5, 6, 7, 8) : painted_color(1, 2, 3, 4));
        }
    }
}

static void only_a_region(void **state)
{
    const struct run_params all = {
        .technique = RG_TECHNIQUE("test", rows),
        .outputs = { &map_out, &own_out, &mixed_out, &mixed_seen_out, &fixed_out, &history_out },
    };
    const struct rg_frame frame = { .rows = rows, .paints = paints };
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params params = run_variant(&all, way);
        struct run run;
        open_noted(&run, *state, &params);
        rg_exec_set_region(run.exec, &wanted);
        for (uint32_t f = 0; f < 2; f++) {
            noted.count = 0;
            run_frame(&run, &frame);
            assert_int_equal(noted.count, AREA_COUNT);
            assert_memory_equal(noted.areas, areas, sizeof(areas));
            check_texels(&run, wanted.region, wanted.reach);
        }
        run_close(&run);
    }
}

static void all_without_it(void **state)
{
    static const VkRect2D whole = WHOLE;
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", rows),
        .outputs = { &map_out, &own_out, &mixed_out, &mixed_seen_out, &fixed_out, &history_out },
    };
    const struct rg_frame frame = { .rows = rows, .paints = paints };
    struct run run;
    open_noted(&run, *state, &params);
    noted.count = 0;
    run_frame(&run, &frame);
    for (uint32_t i = 0; i < AREA_COUNT; i++)
        assert_memory_equal(&noted.areas[i], &whole, sizeof(whole));
    check_texels(&run, whole, whole);
    run_close(&run);
}

/* ---- rectangles of rows ---- */

static const struct rg_image cut = COLOR_IMAGE("cut");
static const struct rg_buffer cut_out = COLOR_BUFFER("cut out");

static void record_cut(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_scissor(cmd, (VkRect2D){ { 0, 0 }, { 4, 8 } });
    painted_draw(cmd, &(struct paint_push){ .color = { { 5, 6, 7, 8 } }, ALL });
    rg_cmd_scissor(cmd, (VkRect2D){ { 6, 0 }, { 2, 8 } });
    painted_draw(cmd, &(struct paint_push){ .color = { { 9, 9, 9, 9 } }, ALL });
}

static const struct rg_pass cut_rows[] = {
    { .name = "cut", CLEAR(cut), PAINTED_BY(record_cut, &paint_frag) },
    RUN_READ("read cut", cut, cut_out),
};

static void scissors_stay_inside(void **state)
{
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", cut_rows),
        .outputs = { &cut_out },
    };
    struct run run;
    run_open(&run, *state, &params);
    rg_exec_set_region(run.exec, &wanted);
    run_frame(&run, &(struct rg_frame){ .rows = cut_rows });
    check_texels(&run, wanted.region, wanted.reach);
    run_close(&run);
}

/* ---- areas of rows ---- */

static const struct rg_image board = COLOR_IMAGE("board");
static const struct rg_image spot = COLOR_IMAGE("spot");
static const struct rg_buffer board_out = COLOR_BUFFER("board out");
static const struct rg_buffer spot_out = COLOR_BUFFER("spot out");
static const VkRect2D spot_area = { { 1, 3 }, { 4, 2 } };

static VkRect2D area_of_spot(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
    return spot_area;
}

static VkRect2D area_beyond(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    return (VkRect2D){ { (int32_t)rg_cmd_extent(cmd).width, 2 }, { 3, 3 } };
}

static void record_never(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
    fail();
}

static const struct rg_pass area_rows[] = {
    { .name = "board", CLEAR(board), PAINTED },
    {
        .name = "on board",
        .color = RG_TARGETS({ &board, RG_LOAD_KEEP }),
        .area = area_of_spot,
        PAINTED,
    },
    {
        .name = "beyond",
        .color = RG_TARGETS({ &board, RG_LOAD_KEEP }),
        .area = area_beyond,
        PAINTED_BY(record_never, &paint_frag),
    },
    { .name = "spot", CLEAR(spot), .area = area_of_spot, PAINTED },
    RUN_READ("read board", board, board_out),
    RUN_READ("read spot", spot, spot_out),
};

/* Row by row, of the texels of `seen`. */
static void check_board(struct run *run, VkRect2D seen)
{
    for (uint32_t i = 0; i < seen.extent.width * seen.extent.height; i++) {
        const uint32_t x = (uint32_t)seen.offset.x + i % seen.extent.width;
        const uint32_t y = (uint32_t)seen.offset.y + i / seen.extent.width;
        const vec4s half = x < 4 ? painted_color(5, 6, 7, 8) : painted_color(1, 2, 3, 4);
        const bool is_on_spot = is_inside(spot_area, x, y);
        painted_check(run, &board_out, i, is_on_spot ? painted_color(9, 9, 9, 9) : half);
        if (is_on_spot)
            painted_check(run, &spot_out, i, half);
    }
}

/* Rows draw in their areas, clear nothing beside them, and are left out where there are none. */
static void areas_of_rows(void **state)
{
    static const struct paint_push area_paints[] = {
        HALF,
        { .color = { { 9, 9, 9, 9 } }, ALL },
        { ALL },
        HALF,
    };
    static const VkRect2D whole = WHOLE, part = PART, both = { { 2, 4 }, { 3, 1 } };
    const struct run_params all = {
        .technique = RG_TECHNIQUE("test", area_rows),
        .outputs = { &board_out, &spot_out },
    };
    const struct rg_frame frame = { .rows = area_rows, .paints = area_paints };
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params params = run_variant(&all, way);
        struct run run;
        open_noted(&run, *state, &params);
        for (int is_part = 0; is_part < 2; is_part++) {
            const VkRect2D seen = is_part ? part : whole, spot_seen = is_part ? both : spot_area;
            if (is_part)
                rg_exec_set_region(run.exec, &(struct rg_exec_region){ part, part });
            noted.count = 0;
            run_frame(&run, &frame);
            assert_int_equal(noted.count, 3);
            assert_memory_equal(&noted.areas[0], &seen, sizeof(seen));
            assert_memory_equal(&noted.areas[1], &spot_seen, sizeof(spot_seen));
            assert_memory_equal(&noted.areas[2], &spot_seen, sizeof(spot_seen));
            check_board(&run, seen);
        }
        run_close(&run);
    }
}

/* ---- further rows ---- */

static VkRect2D no_area(const struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)cmd;
    (void)frame;
    return (VkRect2D){ 0 };
}

/* All of the table but the copy. */
static const struct rg_pass *next_row(const struct rg_pass *row, const struct rg_frame *frame)
{
    return row < frame->rows + 2 ? row + 1 : NULL;
}

#define OVER(target) .color = RG_TARGETS({ &(target), RG_LOAD_KEEP })
static const struct rg_pass further_rows[] = {
    { .name = "board", CLEAR(board), PAINTED },
    { .name = "further", OVER(board), .area = no_area, PAINTED },
    { .name = "furthest", OVER(board), .area = no_area, PAINTED },
    RUN_READ("read board", board, board_out),
};

/* A pass draws the rows that it chooses, each by its own record function, within its area. */
static void further_rows_of_a_pass(void **state)
{
    static const struct paint_push further_paints[] = {
        HALF,
        { .color = { { 9, 9, 9, 9 } }, .from = { { 0, -1 } }, .to = { { 1, 0 } } },
        { .color = { { 3, 3, 3, 3 } }, .from = { { 0, 0 } }, .to = { { 1, 1 } } },
    };
    const struct run_params all = {
        .technique = RG_TECHNIQUE("test", further_rows),
        .more = next_row,
        .outputs = { &board_out },
    };
    const struct rg_frame frame = { .rows = further_rows, .paints = further_paints };
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        const struct run_params params = run_variant(&all, way);
        struct run run;
        open_noted(&run, *state, &params);
        noted.count = noted.begun = 0;
        run_frame(&run, &frame);
        assert_int_equal(noted.begun, 1);
        assert_int_equal(noted.count, 3);
        for (uint32_t i = 0; i < 64; i++)
            painted_check(&run, &board_out, i,
                          i % 8 < 4 ? painted_color(5, 6, 7, 8)
                          : i < 32  ? painted_color(9, 9, 9, 9)
                                    : painted_color(3, 3, 3, 3));
        run_close(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(only_a_region),          ON_DEVICE(all_without_it),
        ON_DEVICE(scissors_stay_inside),   ON_DEVICE(areas_of_rows),
        ON_DEVICE(further_rows_of_a_pass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
