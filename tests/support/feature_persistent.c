/* feature_persistent.c: feature graphs of persistent resources, which survive from frame to frame.
 */
#include "tests/support/feature_graphs.h"

static const struct rg_image sum = COLOR_IMAGE("sum", .persistent = true);
static const struct rg_image seen = COLOR_IMAGE("seen");
static const struct rg_image kept = COLOR_IMAGE("kept", .persistent = true);
static const struct rg_image before = COLOR_IMAGE("before");
/* content of `now` in the last frame, without a copy */
static const struct rg_image now = COLOR_IMAGE("now");
static const struct rg_image last = COLOR_IMAGE("last", .previous = &now);
static const struct rg_image last_seen = COLOR_IMAGE("last seen");
static const struct rg_image nearest = COLOR_IMAGE("nearest");

static const struct rg_image depth = {
    .name = "depth",
    .format = VK_FORMAT_D32_SFLOAT,
    .persistent = true,
};

static const struct rg_image layers =
    COLOR_IMAGE("layers", .width = HISTORY_SIDE, .height = HISTORY_SIDE,
                .layers = HISTORY_LAYER_COUNT, .persistent = true);
static const struct rg_image mips =
    COLOR_IMAGE("mips", .width = HISTORY_SIDE, .height = HISTORY_SIDE, .mips = HISTORY_MIP_COUNT,
                .persistent = true);

static const struct rg_buffer seen_out = COLOR_BUFFER("seen out");
static const struct rg_buffer before_out = COLOR_BUFFER("before out");
static const struct rg_buffer now_out = COLOR_BUFFER("now out");
static const struct rg_buffer last_out = COLOR_BUFFER("last out");
static const struct rg_buffer nearest_out = COLOR_BUFFER("nearest out");
static const struct rg_buffer layers_out = COLOR_BUFFER("layers out");
static const struct rg_buffer mip_out[HISTORY_MIP_COUNT] = {
    COLOR_BUFFER("mip 0 out"),
    COLOR_BUFFER("mip 1 out"),
    COLOR_BUFFER("mip 2 out"),
};

static const struct rg_buffer depth_out = {
    .name = "depth out",
    .size_per_texel = sizeof(float),
    .memory = RG_MEMORY_READBACK,
};

static const struct rg_pass image_rows[] = {
    [HISTORY_SUM] = {
        .name = "sum",
        .color = RG_TARGETS({ &sum, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }),
        PAINTED,
    },
    [HISTORY_SEE] = PAINTED_FETCH("see", sum, seen),
    [HISTORY_BEFORE] = PAINTED_FETCH("before", kept, before),
    [HISTORY_KEEP] = {
        .name = "keep",
        .color = RG_TARGETS({ &kept, RG_LOAD_DISCARD }),
        PAINTED,
    },
    [HISTORY_NOW] = {
        .name = "now",
        .color = RG_TARGETS({ &now, RG_LOAD_CLEAR }),
        PAINTED,
    },
    [HISTORY_LAST] = PAINTED_FETCH("last", last, last_seen),
    [HISTORY_NEAREST] = {
        .name = "nearest",
        .color = RG_TARGETS({ &nearest, RG_LOAD_CLEAR }),
        .depth = { &depth, RG_LOAD_KEEP },
        .depth_compare = VK_COMPARE_OP_GREATER,
        PAINTED,
    },
    [HISTORY_LAYERS] = {
        .name = "layers",
        .repeat = RG_PER_LAYER,
        .color = RG_TARGETS({ &layers, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }),
        PAINTED_BY(painted_record_number, &paint_frag),
    },
    [HISTORY_MIPS] = {
        .name = "mips",
        .repeat = RG_PER_MIP,
        .color = RG_TARGETS({ &mips, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }),
        PAINTED_BY(painted_record_number, &paint_frag),
    },
    RUN_READ("read seen", seen, seen_out),
    RUN_READ("read before", before, before_out),
    RUN_READ("read now", now, now_out),
    RUN_READ("read last", last_seen, last_out),
    RUN_READ("read depth", depth, depth_out),
    RUN_READ("read nearest", nearest, nearest_out),
    RUN_READ("read layers", layers, layers_out),
    RUN_READ("read mip 0", mips, mip_out[0]),
    RUN_READ_PART("read mip 1", mips, mip_out[1], .mip = 1),
    RUN_READ_PART("read mip 2", mips, mip_out[2], .mip = 2),
};

const struct feature feature_history = {
    .name = "feature_history",
    .params = {
        .technique = RG_TECHNIQUE("history", image_rows),
        .outputs = {
            [HISTORY_SEEN_OUT] = &seen_out,
            [HISTORY_BEFORE_OUT] = &before_out,
            [HISTORY_NOW_OUT] = &now_out,
            [HISTORY_LAST_OUT] = &last_out,
            [HISTORY_DEPTH_OUT] = &depth_out,
            [HISTORY_NEAREST_OUT] = &nearest_out,
            [HISTORY_LAYERS_OUT] = &layers_out,
            [HISTORY_MIPS_OUT] = &mip_out[0],
            [HISTORY_MIPS_OUT + 1] = &mip_out[1],
            [HISTORY_MIPS_OUT + 2] = &mip_out[2],
        },
    },
};

static const struct rg_image texels = { .name = "texels", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer scratch = { .name = "scratch", .size_per_texel = sizeof(uint32_t) };

static const struct rg_buffer total = {
    .name = "total",
    .size_per_texel = sizeof(uint32_t),
    .persistent = true,
};

/* buffer whose size is no multiple of four bytes */
static const struct rg_buffer bytes = {
    .name = "bytes",
    .size = HISTORY_BYTES,
    .persistent = true,
};
const struct rg_buffer feature_history_bytes_in = {
    .name = "bytes in",
    .size = HISTORY_BYTES,
    .memory = RG_MEMORY_UPLOAD,
};
static const struct rg_buffer bytes_out = {
    .name = "bytes out",
    .size = HISTORY_BYTES,
    .memory = RG_MEMORY_READBACK,
};
static const struct rg_buffer total_out = FEATURE_NUMBERS("total out");

static const struct rg_pass buffer_rows[] = {
    { .name = "fill", FEATURE_FILL(texels, scratch) },
    FEATURE_ADD("add", texels, total),
    FEATURE_COPY("read total", total, total_out),
    FEATURE_COPY("read bytes", bytes, bytes_out),
    FEATURE_COPY("write bytes", feature_history_bytes_in, bytes),
};

const struct feature feature_history_buffers = {
    .name = "feature_history_buffers",
    .params = {
        .technique = RG_TECHNIQUE("history of buffers", buffer_rows),
        .outputs = {
            [HISTORY_TOTAL_OUT] = &total_out,
            [HISTORY_BYTES_OUT] = &bytes_out,
        },
    },
};
