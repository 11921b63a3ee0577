/* feature_volume_array.c: feature graphs of 3D images, descriptor arrays and indirect counts. */
#include "tests/support/feature_graphs.h"

/* ---- 3D image ---- */

static const struct rg_image volume = {
    .name = "volume",
    .format = VK_FORMAT_R32_UINT,
    .depth = VOLUME_DEPTH,
    .mips = 2,
};
static const struct rg_buffer seen = {
    .name = "seen",
    .size_per_texel = VOLUME_DEPTH * sizeof(uint32_t),
};
static const struct rg_buffer seen_out = {
    .name = "seen out",
    .size_per_texel = VOLUME_DEPTH * sizeof(uint32_t),
    .memory = RG_MEMORY_READBACK,
};
static const struct rg_buffer volume_out = {
    .name = "volume out",
    .size_per_texel = VOLUME_DEPTH * sizeof(uint32_t),
    .memory = RG_MEMORY_READBACK,
};

static void record_volume(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, FEATURE_SIZE / DATA_GROUP, FEATURE_SIZE / DATA_GROUP, VOLUME_DEPTH);
}

static const struct rg_pass volume_rows[] = {
    {
        .name = "fill",
        .kind = RG_COMPUTE,
        .repeat = RG_PER_MIP,
        .uses = RG_USES(FEATURE_SEED, { .image = &volume,
                                        .access = RG_STORAGE_WRITE,
                                        .binding = DATA_TEXELS,
                                        .range = { .each = true } }),
        .comp = &volume_comp,
        .record = record_volume,
    },
    {
        .name = "look",
        .kind = RG_COMPUTE,
        .uses = RG_USES({ .buffer = &seen, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS },
                        { .image = &volume, .access = RG_SAMPLED, .binding = DATA_IMAGE }),
        .comp = &volume_look_comp,
        .record = record_volume,
    },
    FEATURE_COPY("copy seen", seen, seen_out),
    RUN_READ("read volume", volume, volume_out),
};

const struct feature feature_volume = {
    .name = "feature_volume",
    .params = {
        .technique = RG_TECHNIQUE("volume", volume_rows),
        .outputs = {
            [VOLUME_LOOK_OUT] = &seen_out,
            [VOLUME_TEXELS_OUT] = &volume_out,
        },
    },
};

/* ---- descriptor array, and a descriptor set of the application ---- */

static const struct rg_image first = { .name = "first", .format = VK_FORMAT_R32_UINT };
static const struct rg_image second = { .name = "second", .format = VK_FORMAT_R32_UINT };
static const struct rg_image absent = { .name = "absent", .format = VK_FORMAT_R32_UINT };
static const struct rg_fallback seven = { { ARRAY_FALLBACK } };
static const struct rg_buffer list = { .name = "list", .size_per_texel = sizeof(uint32_t) };
static const struct rg_buffer sums = { .name = "sums", .size_per_texel = sizeof(uint32_t) };
static const struct rg_buffer sums_out = FEATURE_NUMBERS("sums out");

const struct rg_set feature_array_set = { "factors" };

/* Binds the frame's descriptor set and dispatches. */
static void record_sums(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_bind_set(cmd, frame->set);
    feature_record_texels(cmd, frame);
}

#define SOURCE(of, number, ...) \
    { \
        .image = &(of), .access = RG_SAMPLED, .binding = DATA_IMAGE, .element = (number), \
        __VA_ARGS__ \
    }

static const struct rg_pass array_rows[] = {
    { .name = "fill first", FEATURE_FILL(first, list) },
    {
        .name = "next",
        .color = RG_TARGETS({ &second, RG_LOAD_DISCARD }),
        .uses = RG_USES(FEATURE_SEED,
                        { .image = &first, .access = RG_SAMPLED, .binding = DATA_TEXELS }),
        PAINTED_BY(painted_record, &next_frag),
    },
    {
        .name = "sum",
        .kind = RG_COMPUTE,
        .uses = RG_USES({ .buffer = &sums, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS },
                        SOURCE(first, 0, .sampler = NULL), SOURCE(second, 1, .sampler = NULL),
                        SOURCE(absent, 2, .fallback = &seven)),
        .set = &feature_array_set,
        .comp = &array_comp,
        .record = record_sums,
    },
    FEATURE_COPY("copy", sums, sums_out),
};

const struct feature feature_array = {
    .name = "feature_array",
    .params = {
        .technique = RG_TECHNIQUE("array", array_rows),
        .outputs = { &sums_out },
    },
};

/* ---- indirect draws with a count from a buffer ---- */

const struct rg_buffer feature_count_commands = {
    .name = "commands",
    .size = sizeof(struct count_commands),
    .memory = RG_MEMORY_UPLOAD,
};
static const struct rg_image drawn = COLOR_IMAGE("drawn");
static const struct rg_image mesh = COLOR_IMAGE("mesh");
static const struct rg_buffer drawn_out = COLOR_BUFFER("drawn out");
static const struct rg_buffer mesh_out = COLOR_BUFFER("mesh out");

static const struct paint_push ones = { .color = { { 1, 1, 1, 1 } }, ALL };

static struct rg_indirect_count commands_at(VkDeviceSize offset)
{
    return (struct rg_indirect_count){
        .commands = &feature_count_commands,
        .offset = offset,
        .count = &feature_count_commands,
        .count_offset = offsetof(struct count_commands, count),
        .max_count = COUNT_MAX,
    };
}

static void record_drawn(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct rg_indirect_count draws = commands_at(offsetof(struct count_commands, draws));
    (void)frame;
    rg_cmd_push(cmd, &ones, sizeof(ones));
    rg_cmd_draw_indirect_count(cmd, &draws);
}

static void record_mesh(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    struct rg_indirect_count draws = commands_at(offsetof(struct count_commands, meshes));
    draws.max_count = 1;
    rg_cmd_push(cmd, &ones, sizeof(ones));
    rg_cmd_draw_mesh_indirect_count(cmd, &frame->mesh, &draws);
}

static const struct rg_pass count_rows[] = {
    {
        .name = "draw",
        .color = RG_TARGETS({ &drawn, RG_LOAD_CLEAR, .blend = RG_BLEND_ADD }),
        .uses = RG_USES({ .buffer = &feature_count_commands, .access = RG_INDIRECT }),
        PAINTED_BY(record_drawn, &paint_frag),
    },
    {
        .name = "mesh",
        .color = RG_TARGETS({ &mesh, RG_LOAD_CLEAR, .blend = RG_BLEND_ADD }),
        .uses = RG_USES({ .buffer = &feature_count_commands, .access = RG_INDIRECT }),
        .vert = &paint_mesh_vert,
        .frag = &paint_frag,
        .vertices = &feature_indirect_vertices,
        .push_size = sizeof(struct paint_push),
        .record = record_mesh,
    },
    RUN_READ("read drawn", drawn, drawn_out),
    RUN_READ("read mesh", mesh, mesh_out),
};

const struct feature feature_count = {
    .name = "feature_count",
    .params = {
        .technique = RG_TECHNIQUE("count", count_rows),
        .outputs = {
            [COUNT_DRAWN_OUT] = &drawn_out,
            [COUNT_MESH_OUT] = &mesh_out,
        },
    },
};
