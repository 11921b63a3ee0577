/* feature_repeated_rows.c: feature graphs of passes that are repeated per layer or per mip. */
#include "tests/support/feature_graphs.h"

/* ---- per layer ---- */

#define SIDES .width = PER_LAYER_SIDE, .height = PER_LAYER_SIDE

static const struct rg_image cube = COLOR_IMAGE("cube", .cube = true, SIDES);
static const struct rg_image cube_depth = {
    .name = "cube depth",
    .format = VK_FORMAT_D32_SFLOAT,
    SIDES,
};
static const struct rg_image cube_copy = COLOR_IMAGE("copy", .layers = 6, SIDES);
static const struct rg_buffer cube_out = COLOR_BUFFER("cube out");
static const struct rg_buffer cube_copy_out = COLOR_BUFFER("copy out");
static const struct rg_buffer cube_seen = {
    .name = "seen",
    .size = 6 * sizeof(vec4s),
    .memory = RG_MEMORY_READBACK,
};

static void record_faces(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, 6, 1, 1);
}

/* Each cube face's rectangle is visible only if the depth of the previous face is cleared. */
static const struct rg_pass layer_rows[] = {
    {
        .name = "draw",
        .repeat = RG_PER_LAYER,
        .color = RG_TARGETS({ &cube, RG_LOAD_CLEAR, .clear.color = { { 7, 7, 7, 7 } } }),
        .depth = { &cube_depth, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        PAINTED_BY(painted_record_number, &paint_frag),
    },
    {
        .name = "copy",
        .repeat = RG_PER_LAYER,
        .color = RG_TARGETS({ &cube_copy, RG_LOAD_DISCARD }),
        .uses = RG_USES({
            .image = &cube,
            .access = RG_SAMPLED,
            .binding = PAINT_SOURCE,
            .range.each = true,
        }),
        PAINTED_BY(painted_record, &fetch_layer_frag),
    },
    {
        .name = "look",
        .kind = RG_COMPUTE,
        .uses =
            RG_USES({ .image = &cube, .access = RG_SAMPLED, .binding = DATA_IMAGE },
                    { .buffer = &cube_seen, .access = RG_STORAGE_WRITE, .binding = DATA_COLORS }),
        .comp = &faces_comp,
        .record = record_faces,
    },
    RUN_READ("read", cube, cube_out),
    RUN_READ("read copy", cube_copy, cube_copy_out),
};

const struct feature feature_per_layer = {
    .name = "feature_per_layer",
    .params = {
        .technique = RG_TECHNIQUE("per layer", layer_rows),
        .outputs = {
            [PER_LAYER_CUBE_OUT] = &cube_out,
            [PER_LAYER_COPY_OUT] = &cube_copy_out,
            [PER_LAYER_SEEN_OUT] = &cube_seen,
        },
    },
};

/* ---- per mip ---- */

static const struct rg_image mip_from = COLOR_IMAGE("from", .mips = RG_ALL_MIPS, .array = true);
static const struct rg_image mip_to = COLOR_IMAGE("to", .mips = 2, .scale = 0.5F);
static const struct rg_buffer from_2_out = COLOR_BUFFER("from 2");
static const struct rg_buffer from_3_out = COLOR_BUFFER("from 3");
static const struct rg_buffer to_0_out = COLOR_BUFFER("to 0");
static const struct rg_buffer to_1_out = COLOR_BUFFER("to 1");

static const struct rg_pass mip_rows[] = {
    {
        .name = "number",
        .repeat = RG_PER_MIP,
        .color = RG_TARGETS({ &mip_from, RG_LOAD_DISCARD }),
        PAINTED_BY(painted_record_number, &paint_frag),
    },
    {
        .name = "copy",
        .repeat = RG_PER_MIP,
        .color = RG_TARGETS({ &mip_to, RG_LOAD_DISCARD }),
        .uses = RG_USES({
            .image = &mip_from,
            .access = RG_SAMPLED,
            .binding = PAINT_SOURCE,
            .range = { .mip = 1, .each = true },
        }),
        PAINTED_BY(painted_record, &fetch_layer_frag),
    },
    RUN_READ_PART("read 2", mip_from, from_2_out, .mip = 2),
    RUN_READ_PART("read 3", mip_from, from_3_out, .mip = 3),
    RUN_READ_PART("read to", mip_to, to_0_out, 0),
    RUN_READ_PART("read to 1", mip_to, to_1_out, .mip = 1),
};

const struct feature feature_per_mip = {
    .name = "feature_per_mip",
    .params = {
        .technique = RG_TECHNIQUE("per mip", mip_rows),
        .outputs = {
            [PER_MIP_FROM_2_OUT] = &from_2_out,
            [PER_MIP_FROM_3_OUT] = &from_3_out,
            [PER_MIP_TO_0_OUT] = &to_0_out,
            [PER_MIP_TO_1_OUT] = &to_1_out,
        },
    },
};
