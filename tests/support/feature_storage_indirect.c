/* feature_storage_indirect.c: feature graphs of storage, texel buffers, indirect commands, imports,
 * present. */
#include "tests/support/feature_graphs.h"

static void record_triangles(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    painted_draw(cmd, &(struct paint_push){ ALL });
}

static const struct rg_image numbers = { .name = "numbers", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer list = { .name = "list", .size_per_texel = sizeof(uint32_t) };
static const struct rg_buffer numbers_out = FEATURE_NUMBERS("numbers out");

static const struct rg_image next = { .name = "next", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer next_out = FEATURE_NUMBERS("next out");
static const struct rg_buffer list_out = FEATURE_NUMBERS("list out");

static const struct rg_pass storage_rows[] = {
    { .name = "fill", FEATURE_FILL(numbers, list) },
    FEATURE_ADD("add", numbers, list),
    {
        .name = "next",
        .color = RG_TARGETS({ &next, RG_LOAD_DISCARD }),
        .uses = RG_USES(FEATURE_SEED,
                        { .image = &numbers, .access = RG_SAMPLED, .binding = DATA_TEXELS }),
        PAINTED_BY(record_triangles, &next_frag),
    },
    RUN_READ("read numbers", numbers, numbers_out),
    RUN_READ("read next", next, next_out),
    FEATURE_COPY("copy list", list, list_out),
};

const struct feature feature_storage = {
    .name = "feature_storage",
    .params = {
        .technique = RG_TECHNIQUE("storage", storage_rows),
        .outputs = {
            [STORAGE_NUMBERS_OUT] = &numbers_out,
            [STORAGE_NEXT_OUT] = &next_out,
            [STORAGE_LIST_OUT] = &list_out,
        },
    },
};

/* ---- texel buffers ---- */

static const struct rg_buffer texels = {
    .name = "texels",
    .size_per_texel = sizeof(uint32_t),
    .format = VK_FORMAT_R32_UINT,
};
static const struct rg_buffer doubled = {
    .name = "doubled",
    .size_per_texel = sizeof(uint32_t),
    .format = VK_FORMAT_R32_UINT,
};
static const struct rg_buffer doubled_out = FEATURE_NUMBERS("doubled out");

static const struct rg_pass texels_rows[] = {
    { .name = "fill", FEATURE_FILL(numbers, texels) },
    {
        .name = "double",
        .kind = RG_COMPUTE,
        .uses = RG_USES({ .buffer = &doubled,
                          .access = RG_STORAGE_WRITE,
                          .binding = DATA_NUMBERS,
                          .texels = true },
                        { .buffer = &texels, .access = RG_SAMPLED, .binding = DATA_TEXELS }),
        .comp = &texels_comp,
        .record = feature_record_texels,
    },
    FEATURE_COPY("copy", doubled, doubled_out),
};

const struct feature feature_texels = {
    .name = "feature_texels",
    .params = {
        .technique = RG_TECHNIQUE("texels", texels_rows),
        .outputs = { &doubled_out },
    },
};

/* ---- indirect ---- */

static const struct rg_buffer commands = {
    .name = "commands",
    .size = sizeof(struct data_commands),
};
static const struct rg_image drawn = COLOR_IMAGE("drawn");
static const struct rg_image mesh = COLOR_IMAGE("mesh");
static const struct rg_buffer drawn_out = COLOR_BUFFER("drawn out");
static const struct rg_buffer mesh_out = COLOR_BUFFER("mesh out");

static const VkVertexInputAttributeDescription attributes[] = {
    { .location = 2, .format = VK_FORMAT_R32G32_SFLOAT },
};
const struct rg_vertex_layout feature_indirect_vertices = { sizeof(vec2s), 1, attributes };

static const struct paint_push ones = { .color = { { 1, 1, 1, 1 } }, ALL };

static void record_one(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch(cmd, 1, 1, 1);
}

static void record_fill(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_dispatch_indirect(cmd, &commands, offsetof(struct data_commands, groups));
}

static void record_drawn(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_push(cmd, &ones, sizeof(ones));
    rg_cmd_draw_indirect(cmd, &commands, offsetof(struct data_commands, vertices));
}

static void record_mesh(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &ones, sizeof(ones));
    rg_cmd_draw_mesh_indirect(cmd, &frame->mesh, &commands,
                              offsetof(struct data_commands, indices));
}

static const struct rg_pass indirect_rows[] = {
    {
        .name = "commands",
        .kind = RG_COMPUTE,
        .uses =
            RG_USES(FEATURE_SEED,
                    { .buffer = &commands, .access = RG_STORAGE_WRITE, .binding = DATA_COMMANDS }),
        .comp = &commands_comp,
        .record = record_one,
    },
    {
        .name = "fill",
        .kind = RG_COMPUTE,
        .uses = RG_USES(FEATURE_SEED,
                        { .image = &numbers, .access = RG_STORAGE_WRITE, .binding = DATA_TEXELS },
                        { .buffer = &list, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS },
                        { .buffer = &commands, .access = RG_INDIRECT }),
        .comp = &fill_comp,
        .record = record_fill,
    },
    {
        .name = "draw",
        .color = RG_TARGETS({ &drawn, RG_LOAD_CLEAR }),
        .uses = RG_USES({ .buffer = &commands, .access = RG_INDIRECT }),
        PAINTED_BY(record_drawn, &paint_frag),
    },
    {
        .name = "mesh",
        .color = RG_TARGETS({ &mesh, RG_LOAD_CLEAR }),
        .uses = RG_USES({ .buffer = &commands, .access = RG_INDIRECT }),
        .vert = &paint_mesh_vert,
        .frag = &paint_frag,
        .vertices = &feature_indirect_vertices,
        .push_size = sizeof(struct paint_push),
        .record = record_mesh,
    },
    RUN_READ("read numbers", numbers, numbers_out),
    RUN_READ("read drawn", drawn, drawn_out),
    RUN_READ("read mesh", mesh, mesh_out),
};

const struct feature feature_indirect = {
    .name = "feature_indirect",
    .params = {
        .technique = RG_TECHNIQUE("indirect", indirect_rows),
        .outputs = {
            [INDIRECT_NUMBERS_OUT] = &numbers_out,
            [INDIRECT_DRAWN_OUT] = &drawn_out,
            [INDIRECT_MESH_OUT] = &mesh_out,
        },
    },
};

/* ---- imports ---- */

const struct rg_image feature_imports_picture = COLOR_IMAGE("picture");
const struct rg_buffer feature_imports_totals = {
    .name = "totals",
    .size_per_texel = sizeof(uint32_t),
};
static const struct rg_image seen = COLOR_IMAGE("seen");
static const struct rg_buffer seen_out = COLOR_BUFFER("seen out");
static const struct rg_buffer totals_out = FEATURE_NUMBERS("totals out");

static const struct rg_pass import_rows[] = {
    [IMPORTS_ADD] = {
        .name = "add",
        .color = RG_TARGETS({ &feature_imports_picture, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }),
        PAINTED,
    },
    [IMPORTS_LOOK] = PAINTED_FETCH("look", feature_imports_picture, seen),
    { .name = "fill", FEATURE_FILL(numbers, list) },
    FEATURE_ADD("add numbers", numbers, feature_imports_totals),
    RUN_READ("read seen", seen, seen_out),
    FEATURE_COPY("read totals", feature_imports_totals, totals_out),
};

static const struct rg_import imports[] = {
    { .image = &feature_imports_picture, .access = RG_SAMPLED },
    { .buffer = &feature_imports_totals, .access = RG_COPY_SRC },
};

const struct feature feature_imports = {
    .name = "feature_imports",
    .params = {
        .technique = RG_TECHNIQUE("imports", import_rows),
        .outputs = {
            [IMPORTS_SEEN_OUT] = &seen_out,
            [IMPORTS_TOTALS_OUT] = &totals_out,
        },
        .kept = {
            { .image = &feature_imports_picture, .access = RG_SAMPLED },
            { .buffer = &feature_imports_totals, .access = RG_COPY_SRC },
        },
        .imports = imports,
        .import_count = sizeof(imports) / sizeof(imports[0]),
    },
};

/* ---- presenting ---- */

const struct rg_image feature_present_picture = COLOR_IMAGE("picture");
static const struct rg_buffer picture_out = COLOR_BUFFER("picture out");

static const struct rg_pass present_rows[] = {
    [PRESENT_PAINT] = {
        .name = "paint",
        .color = RG_TARGETS({ &feature_present_picture, RG_LOAD_CLEAR }),
        PAINTED,
    },
    [PRESENT_LOOK] = PAINTED_FETCH("look", feature_present_picture, seen),
    RUN_READ("read picture", feature_present_picture, picture_out),
    RUN_READ("read seen", seen, seen_out),
};

static const struct rg_import shown[] = {
    { .image = &feature_present_picture },
};

const struct feature feature_present = {
    .name = "feature_present",
    .params = {
        .technique = RG_TECHNIQUE("present", present_rows),
        .outputs = {
            [PRESENT_PICTURE_OUT] = &picture_out,
            [PRESENT_SEEN_OUT] = &seen_out,
        },
        .kept = { { .image = &feature_present_picture, .access = RG_PRESENT } },
        .imports = shown,
        .import_count = 1,
    },
};
