/* feature_conditional_rows.c: feature graph of conditional rows. */
#include "tests/support/feature_graphs.h"

#define WANTED .when = painted_when

/* rendered in some frames, displayed in all frames */
static const struct rg_image captured =
    COLOR_IMAGE("captured", .layers = WHEN_LAYER_COUNT, .persistent = true);
static const struct rg_image shown = COLOR_IMAGE("shown");
static const struct rg_buffer shown_out = COLOR_BUFFER("shown out");

/* cleared in some frames, blended to in all frames */
static const struct rg_image board = COLOR_IMAGE("board", .persistent = true);
static const struct rg_buffer board_out = COLOR_BUFFER("board out");

/* written by one conditional pass, read by another one */
static const struct rg_image link = COLOR_IMAGE("link");
static const struct rg_image result = COLOR_IMAGE("result", .persistent = true);
static const struct rg_buffer result_out = COLOR_BUFFER("result out");

/* outputs of copies and compute passes */
static const struct rg_buffer snapshot = {
    .name = "snapshot",
    .size_per_texel = 4 * sizeof(float),
    .persistent = true,
};
static const struct rg_image numbers = {
    .name = "numbers",
    .format = VK_FORMAT_R32_UINT,
    .persistent = true,
};
static const struct rg_buffer list = {
    .name = "list",
    .size_per_texel = sizeof(uint32_t),
    .persistent = true,
};
static const struct rg_buffer snapshot_out = COLOR_BUFFER("snapshot out");
static const struct rg_buffer numbers_out = FEATURE_NUMBERS("numbers out");
static const struct rg_buffer list_out = FEATURE_NUMBERS("list out");

static const struct rg_pass rows[] = {
    [WHEN_CAPTURE] = {
        .name = "capture",
        .repeat = RG_PER_LAYER,
        .color = RG_TARGETS({ &captured, RG_LOAD_DISCARD }),
        PAINTED_BY(painted_record_number, &paint_frag),
        WANTED,
    },
    [WHEN_SHOW] = {
        .name = "show",
        .color = RG_TARGETS({ &shown, RG_LOAD_DISCARD }),
        .uses = RG_USES({
            .image = &captured,
            .access = RG_SAMPLED,
            .binding = PAINT_SOURCE,
            .range.layer = 1,
        }),
        PAINTED_BY(painted_record, &fetch_layer_frag),
    },
    [WHEN_CLEAR] = {
        .name = "clear",
        .color = RG_TARGETS({ &board, RG_LOAD_CLEAR, .clear.color = { { 7, 7, 7, 7 } } }),
        PAINTED,
        WANTED,
    },
    [WHEN_MARK] = {
        .name = "mark",
        .color = RG_TARGETS({ &board, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }),
        PAINTED,
    },
    [WHEN_FIRST] = {
        .name = "first",
        .color = RG_TARGETS({ &link, RG_LOAD_CLEAR, .clear.color = { { 5, 5, 5, 5 } } }),
        PAINTED,
        WANTED,
    },
    [WHEN_SECOND] = {
        .name = "second",
        .color = RG_TARGETS({ &result, RG_LOAD_DISCARD }),
        .uses = RG_USES(PAINTED_SOURCE(link)),
        PAINTED_BY(painted_record, &fetch_frag),
        WANTED,
    },
    {
        .name = "snapshot",
        .kind = RG_TRANSFER,
        .uses = RG_USES({ .image = &captured, .access = RG_COPY_SRC, .range.layer_count = 1 },
                        { .buffer = &snapshot, .access = RG_COPY_DST }),
        .record = run_record_read,
        WANTED,
    },
    { .name = "number", FEATURE_FILL(numbers, list), WANTED },
    RUN_READ("read shown", shown, shown_out),
    RUN_READ("read board", board, board_out),
    RUN_READ("read result", result, result_out),
    FEATURE_COPY("read snapshot", snapshot, snapshot_out),
    RUN_READ("read numbers", numbers, numbers_out),
    FEATURE_COPY("read list", list, list_out),
};

const struct feature feature_when = {
    .name = "feature_conditional",
    .params = {
        .technique = RG_TECHNIQUE("conditional", rows),
        .outputs = {
            [WHEN_SHOWN_OUT] = &shown_out,
            [WHEN_BOARD_OUT] = &board_out,
            [WHEN_RESULT_OUT] = &result_out,
            [WHEN_SNAPSHOT_OUT] = &snapshot_out,
            [WHEN_NUMBERS_OUT] = &numbers_out,
            [WHEN_LIST_OUT] = &list_out,
        },
    },
};
