/* test_exec_state.c: the fixed-function state of raster passes: depth, blend, faces, vertices. */
#include <math.h>

#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"
#include "tests/support/rectangle_rows.h"

/* ---- depth ---- */

#define DEPTH_IMAGE(title) \
    { \
        .name = (title), .format = VK_FORMAT_D32_SFLOAT \
    }
#define DEPTH_BUFFER(title) \
    { \
        .name = (title), .size_per_texel = sizeof(float), .memory = RG_MEMORY_READBACK \
    }

static const struct rg_image depth = DEPTH_IMAGE("depth");
static const struct rg_image reversed = DEPTH_IMAGE("reversed depth");
static const struct rg_image near = COLOR_IMAGE("near");
static const struct rg_image reversed_near = COLOR_IMAGE("reversed near");
static const struct rg_image tested = COLOR_IMAGE("tested");
static const struct rg_image seen = COLOR_IMAGE("seen");
static const struct rg_buffer depth_out = DEPTH_BUFFER("depth out");
static const struct rg_buffer reversed_out = DEPTH_BUFFER("reversed out");
static const struct rg_buffer near_out = COLOR_BUFFER("near out");
static const struct rg_buffer reversed_near_out = COLOR_BUFFER("reversed near out");
static const struct rg_buffer tested_out = COLOR_BUFFER("tested out");
static const struct rg_buffer seen_out = COLOR_BUFFER("seen out");

static const struct rg_pass depth_rows[] = {
    {
        .name = "depth alone",
        .depth = { &depth, RG_LOAD_CLEAR, .clear.depthStencil.depth = 0.5F },
        PAINTED_BY(painted_record, NULL),
    },
    {
        .name = "nearer",
        .color = RG_TARGETS({ &near, RG_LOAD_CLEAR }),
        .depth = { &depth, RG_LOAD_KEEP },
        PAINTED,
    },
    {
        .name = "reversed depth",
        .depth = { &reversed, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        PAINTED_BY(painted_record, NULL),
    },
    {
        .name = "reversed nearer",
        .color = RG_TARGETS({ &reversed_near, RG_LOAD_CLEAR }),
        .depth = { &reversed, RG_LOAD_KEEP },
        .depth_compare = VK_COMPARE_OP_GREATER,
        PAINTED,
    },
    {
        .name = "only tested",
        .color = RG_TARGETS({ &tested, RG_LOAD_CLEAR }),
        .depth = { &depth },
        .depth_read_only = true,
        PAINTED,
    },
    {
        .name = "look",
        .color = RG_TARGETS({ &seen, RG_LOAD_DISCARD }),
        .uses = RG_USES({ .image = &depth, .access = RG_SAMPLED, .binding = PAINT_SOURCE }),
        PAINTED_BY(painted_record, &fetch_frag),
    },
    RUN_READ("read depth", depth, depth_out),
    RUN_READ("read reversed", reversed, reversed_out),
    RUN_READ("read near", near, near_out),
    RUN_READ("read reversed near", reversed_near, reversed_near_out),
    RUN_READ("read tested", tested, tested_out),
    RUN_READ("read seen", seen, seen_out),
};

/* Left: 0.25, and 0.4 is farther, reversed 0.2. Right: 0.5, then 0.4; reversed 0, then 0.2. */
static void check_depth(struct run *run)
{
    const float *depths = run_data(run, &depth_out);
    const float *reversed_depths = run_data(run, &reversed_out);
    const vec4s *seen_texels = run_data(run, &seen_out);
    for (uint32_t i = 0; i < 64; i++) {
        const bool left = i % 8 < 4;
        CHECK_NEAR(depths[i], left ? 0.25F : 0.4F, 0);
        CHECK_NEAR(reversed_depths[i], left ? 0.25F : 0.2F, 0);
        painted_check(run, &near_out, i,
                      left ? painted_color(0, 0, 0, 0) : painted_color(1, 0, 0, 1));
        painted_check(run, &reversed_near_out, i,
                      left ? painted_color(0, 0, 0, 0) : painted_color(2, 0, 0, 2));
        painted_check(run, &tested_out, i,
                      left ? painted_color(0, 0, 0, 0) : painted_color(5, 5, 5, 5));
        CHECK_NEAR(seen_texels[i].x, left ? 8.25F : 8.4F, 0);
    }
}

static void depth_is_tested(void **state)
{
    static const struct paint_push paints[] = {
        { LEFT_HALF, .depth = 0.25F },
        { .color = { { 1, 0, 0, 1 } }, ALL, .depth = 0.4F },
        { LEFT_HALF, .depth = 0.25F },
        { .color = { { 2, 0, 0, 2 } }, ALL, .depth = 0.2F },
        { .color = { { 5, 5, 5, 5 } }, ALL, .depth = 0.3F },
        { .color = { { 8, 8, 8, 8 } }, ALL },
    };
    PAINTED_VARIANTS(state, depth_rows, paints, check_depth,
                     .outputs = { &depth_out, &reversed_out, &near_out, &reversed_near_out,
                                  &tested_out, &seen_out });
}

/* ---- blending ---- */

static const struct rg_image over = COLOR_IMAGE("over");
static const struct rg_image sum = COLOR_IMAGE("sum");
static const struct rg_buffer over_out = COLOR_BUFFER("over out");
static const struct rg_buffer sum_out = COLOR_BUFFER("sum out");

/* A blend of its own for each target; in the second row none for the first. */
static const struct rg_pass blend_rows[] = {
    {
        .name = "blend",
        .color = RG_TARGETS(
            { &over, RG_LOAD_CLEAR, .clear.color = { { 0.5F, 0.25F, 1, 1 } },
              .blend = RG_BLEND_OVER },
            { &sum, RG_LOAD_CLEAR, .clear.color = { { 1, 2, 3, 4 } }, .blend = RG_BLEND_ADD }),
        PAINTED_BY(painted_record, &paint_two_frag),
    },
    {
        .name = "blend the second",
        .color = RG_TARGETS({ &over, RG_LOAD_KEEP }, { &sum, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }),
        PAINTED_BY(painted_record, &paint_two_frag),
    },
    RUN_READ("read over", over, over_out),
    RUN_READ("read sum", sum, sum_out),
};

static void check_blend(struct run *run)
{
    for (uint32_t i = 0; i < 64; i++) {
        const bool left = i % 8 < 4;
        painted_check(run, &over_out, i,
                      left ? painted_color(16, 32, 64, 128)
                           : painted_color(0.5F, 0.625F, 0.625F, 1));
        painted_check(run, &sum_out, i,
                      left ? painted_color(129.5F, 66.125F, 35.5F, 20.25F)
                           : painted_color(1.5F, 2.125F, 3.5F, 4.25F));
    }
}

static void targets_are_blended(void **state)
{
    static const struct paint_push paints[] = {
        { .color = { { 0.25F, 0.5F, 0.125F, 0.5F } }, ALL },
        { .color = { { 16, 32, 64, 128 } }, LEFT_HALF },
    };
    PAINTED_VARIANTS(state, blend_rows, paints, check_blend, .outputs = { &over_out, &sum_out });
}

/* ---- any blend ---- */

static const struct rg_image product = COLOR_IMAGE("product");
static const struct rg_image masked = COLOR_IMAGE("masked");
static const struct rg_buffer product_out = COLOR_BUFFER("product out");
static const struct rg_buffer masked_out = COLOR_BUFFER("masked out");

static const VkPipelineColorBlendAttachmentState multiply = {
    .blendEnable = VK_TRUE,
    .srcColorBlendFactor = VK_BLEND_FACTOR_DST_COLOR,
    .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
    .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
    .alphaBlendOp = VK_BLEND_OP_REVERSE_SUBTRACT,
    .colorWriteMask = 0xf,
};
static const VkPipelineColorBlendAttachmentState green_alone = {
    .colorWriteMask = VK_COLOR_COMPONENT_G_BIT,
};

static const struct rg_pass mixed_rows[] = {
    {
        .name = "multiply",
        .color = RG_TARGETS({ &product, RG_LOAD_CLEAR, .clear.color = { { 2, 3, 4, 5 } },
                              .blend_state = &multiply }),
        PAINTED,
    },
    {
        .name = "mask",
        .color = RG_TARGETS({ &masked, RG_LOAD_CLEAR, .clear.color = { { 2, 3, 4, 5 } },
                              .blend_state = &green_alone }),
        PAINTED,
    },
    RUN_READ("read product", product, product_out),
    RUN_READ("read masked", masked, masked_out),
};

static void check_mixed(struct run *run)
{
    painted_check_all(run, &product_out, 64, painted_color(1, 6, 2, 3));
    painted_check_all(run, &masked_out, 64, painted_color(2, 8, 4, 5));
}

static void any_blend_is_drawn(void **state)
{
    static const struct paint_push paints[] = {
        { .color = { { 0.5F, 2, 0.5F, 2 } }, ALL },
        { .color = { { 7, 8, 9, 10 } }, ALL },
    };
    PAINTED_VARIANTS(state, mixed_rows, paints, check_mixed,
                     .outputs = { &product_out, &masked_out });
}

/* ---- stencil, and a bias of depth ---- */

static const struct rg_image marks = { .name = "marks", .format = VK_FORMAT_D32_SFLOAT_S8_UINT };
static const struct rg_image inside = COLOR_IMAGE("inside");
static const struct rg_buffer inside_out = COLOR_BUFFER("inside out");

#define FACES(...) \
    { \
        .front = { __VA_ARGS__ }, .back = { __VA_ARGS__ } \
    }
static const struct rg_stencil mark =
    FACES(.passOp = VK_STENCIL_OP_INCREMENT_AND_CLAMP, .depthFailOp = VK_STENCIL_OP_ZERO,
          .compareOp = VK_COMPARE_OP_ALWAYS, .compareMask = 0xff, .writeMask = 0xff);
static const struct rg_stencil is_marked =
    FACES(.compareOp = VK_COMPARE_OP_EQUAL, .compareMask = 0xff, .reference = 8);

/* The third is as far as the first, but for its bias. */
static const struct rg_pass stencil_rows[] = {
    {
        .name = "mark",
        .depth = { &marks, RG_LOAD_CLEAR, .clear.depthStencil = { 1, 7 } },
        .stencil = &mark,
        PAINTED_BY(painted_record, NULL),
    },
    {
        .name = "inside",
        .color = RG_TARGETS({ &inside, RG_LOAD_CLEAR }),
        .depth = { &marks },
        .depth_read_only = true,
        .stencil = &is_marked,
        PAINTED,
    },
    {
        .name = "behind",
        .color = RG_TARGETS({ &inside }),
        .depth = { &marks },
        .depth_bias = { .constant = 1 << 20 },
        PAINTED,
    },
    {
        .name = "before",
        .color = RG_TARGETS({ &inside }),
        .depth = { &marks },
        .depth_bias = { .constant = -(1 << 20) },
        PAINTED,
    },
    RUN_READ("read inside", inside, inside_out),
};

static void check_stencil(struct run *run)
{
    for (uint32_t i = 0; i < 64; i++) {
        const bool left = i % 8 < 4, top = i < 32;
        const vec4s color = left && top ? painted_color(3, 3, 3, 3)
                            : left      ? painted_color(1, 1, 1, 1)
                                        : painted_color(0, 0, 0, 0);
        painted_check(run, &inside_out, i, color);
    }
}

static void stencil_is_tested(void **state)
{
    static const struct paint_push paints[] = {
        { LEFT_HALF, .depth = 0.5F },
        { .color = { { 1, 1, 1, 1 } }, ALL },
        { .color = { { 2, 2, 2, 2 } }, LEFT_HALF, .depth = 0.5F },
        { .color = { { 3, 3, 3, 3 } }, .from = { { -1, -1 } }, .to = { { 0, 0 } }, .depth = 0.5F },
    };
    PAINTED_VARIANTS(state, stencil_rows, paints, check_stencil, .outputs = { &inside_out });
}

/* ---- faces and topology ---- */

static const struct rg_image faces = COLOR_IMAGE("faces");
static const struct rg_buffer faces_out = COLOR_BUFFER("faces out");

/* The rectangle is counter-clockwise. */
static const struct rg_pass faces_rows[] = {
    { .name = "front",
      .color = RG_TARGETS({ &faces, RG_LOAD_CLEAR }),
      .cull = VK_CULL_MODE_BACK_BIT,
      PAINTED },
    { .name = "back", .color = RG_TARGETS({ &faces }), .cull = VK_CULL_MODE_FRONT_BIT, PAINTED },
    { .name = "front of clockwise",
      .color = RG_TARGETS({ &faces }),
      .cull = VK_CULL_MODE_BACK_BIT,
      .front = VK_FRONT_FACE_CLOCKWISE,
      PAINTED },
    { .name = "lines",
      .color = RG_TARGETS({ &faces }),
      .topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST,
      PAINTED },
    RUN_READ("read", faces, faces_out),
};

/* The second line is a diagonal. */
static void check_faces(struct run *run)
{
    painted_check(run, &faces_out, 3 * 8 + 3, painted_color(4, 4, 4, 4));
    painted_check(run, &faces_out, 6 * 8 + 2, painted_color(1, 1, 1, 1));
    painted_check(run, &faces_out, 2 * 8 + 6, painted_color(1, 1, 1, 1));
}

static void faces_are_culled(void **state)
{
    static const struct paint_push paints[] = {
        { .color = { { 1, 1, 1, 1 } }, ALL },
        { .color = { { 2, 2, 2, 2 } }, ALL },
        { .color = { { 3, 3, 3, 3 } }, ALL },
        { .color = { { 4, 4, 4, 4 } }, ALL },
    };
    PAINTED_VARIANTS(state, faces_rows, paints, check_faces, .outputs = { &faces_out });
}

/* ---- vertices from a buffer ---- */

struct vertex {
    float other[3];
    float position[2];
};

static const VkVertexInputAttributeDescription attributes[] = {
    { .location = 2,
      .format = VK_FORMAT_R32G32_SFLOAT,
      .offset = offsetof(struct vertex, position) },
};
static const struct rg_vertex_layout layout = { sizeof(struct vertex), 1, attributes };
static const struct rg_image drawn = COLOR_IMAGE("drawn");
static const struct rg_buffer drawn_out = COLOR_BUFFER("drawn out");
static const struct rg_image part = COLOR_IMAGE("part");
static const struct rg_buffer part_out = COLOR_BUFFER("part out");

static void record_mesh(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, frame->paints, sizeof(*frame->paints));
    rg_cmd_draw_mesh(cmd, &frame->mesh);
    rg_cmd_draw_mesh(cmd, &(struct rg_mesh){ 0 });
}

/* The second triangle, within a rectangle; of the first call nothing lies in its own. */
static void record_part(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, frame->paints, sizeof(*frame->paints));
    rg_cmd_scissor(cmd, (VkRect2D){ { 6, 0 }, { 2, 8 } });
    rg_cmd_draw_mesh(cmd, &frame->mesh);
    rg_cmd_scissor(cmd, (VkRect2D){ { 2, 2 }, { 4, 3 } });
    rg_cmd_draw_mesh_part(cmd, &frame->mesh, 3, 3);
    rg_cmd_draw_mesh_part(cmd, &frame->mesh, 0, 0);
}

#define DRAWN \
    .vert = &paint_mesh_vert, .frag = &paint_frag, .vertices = &layout, \
    .push_size = sizeof(struct paint_push)

static const struct rg_pass drawn_rows[] = {
    {
        .name = "draw",
        .color = RG_TARGETS({ &drawn, RG_LOAD_CLEAR }),
        .record = record_mesh,
        DRAWN,
    },
    {
        .name = "part",
        .color = RG_TARGETS({ &part, RG_LOAD_CLEAR }),
        .record = record_part,
        DRAWN,
    },
    RUN_READ("read", drawn, drawn_out),
    RUN_READ("read part", part, part_out),
};

static void check_drawn(struct run *run)
{
    for (uint32_t i = 0; i < 64; i++) {
        const uint32_t x = i % 8;
        const uint32_t y = i / 8;
        const bool lower = 2 * x + 1 > 7 - y; /* right of the line between both triangles */
        const bool within = x >= 2 && x < 4 && y >= 2 && y < 5;
        painted_check(run, &drawn_out, i,
                      x < 4 ? painted_color(1, 2, 3, 4) : painted_color(0, 0, 0, 0));
        painted_check(run, &part_out, i,
                      within && lower ? painted_color(1, 2, 3, 4) : painted_color(0, 0, 0, 0));
    }
}

/* Draws the mesh in each variant of run_variants(). */
static void draw_variants(struct gpu *gpu, const struct rg_mesh *mesh)
{
    static const struct paint_push paint = { .color = { { 1, 2, 3, 4 } } };
    const struct rg_frame frame = { .paints = &paint, .mesh = *mesh };
    run_variants(gpu,
                 &(struct run_params){
                     .technique = RG_TECHNIQUE("test", drawn_rows),
                     .outputs = { &drawn_out, &part_out },
                 },
                 &frame, check_drawn);
}

/* A mesh in the middle of buffers that several share, with indices of 16 bits. */
static void mesh_of_a_pool_is_drawn(void **state)
{
    static const struct vertex vertices[] = {
        { { 9, 9, 9 }, { 1, 1 } },   { { 9, 9, 9 }, { 1, 1 } },  { { 9, 9, 9 }, { 1, 1 } },
        { { 9, 9, 9 }, { -1, -1 } }, { { 9, 9, 9 }, { -1, 1 } }, { { 9, 9, 9 }, { 0, -1 } },
        { { 9, 9, 9 }, { 0, 1 } },
    };
    static const uint16_t indices[] = { 9, 9, 0, 1, 2, 2, 1, 3, 9, 9 };
    static const VkDeviceSize offset = sizeof(struct vertex);
    struct gpu_buffer buffers[2];
    assert_int_equal(gpu_buffer_create(*state, &buffers[0], VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                                       vertices, sizeof(vertices), "vertices"),
                     STATUS_OK);
    assert_int_equal(gpu_buffer_create(*state, &buffers[1], VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                       indices, sizeof(indices), "indices"),
                     STATUS_OK);
    draw_variants(*state, &(struct rg_mesh){
                              .vertices = buffers[0].buffer,
                              .indices = buffers[1].buffer,
                              .index_count = 6,
                              .vertex_offsets = &offset,
                              .index_offset = 2 * sizeof(*indices),
                              .short_indices = true,
                              .first_vertex = 2,
                          });
    gpu_buffer_destroy(*state, &buffers[0]);
    gpu_buffer_destroy(*state, &buffers[1]);
}

static void mesh_is_drawn(void **state)
{
    static const struct vertex vertices[] = {
        { { 9, 9, 9 }, { 1, 1 } },  { { 9, 9, 9 }, { -1, -1 } }, { { 9, 9, 9 }, { -1, 1 } },
        { { 9, 9, 9 }, { 0, -1 } }, { { 9, 9, 9 }, { 0, 1 } },
    };
    static const uint32_t indices[] = { 1, 2, 3, 3, 2, 4 };
    struct gpu *gpu = *state;
    struct gpu_buffer vertex_buffer;
    struct gpu_buffer index_buffer;
    assert_int_equal(gpu_buffer_create(gpu, &vertex_buffer, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                                       vertices, sizeof(vertices), "vertices"),
                     STATUS_OK);
    assert_int_equal(gpu_buffer_create(gpu, &index_buffer, VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                       indices, sizeof(indices), "indices"),
                     STATUS_OK);
    draw_variants(gpu, &(struct rg_mesh){ vertex_buffer.buffer, index_buffer.buffer, 6 });
    gpu_buffer_destroy(gpu, &vertex_buffer);
    gpu_buffer_destroy(gpu, &index_buffer);
}

/* ---- viewport ---- */

static const struct rg_image viewed = COLOR_IMAGE("viewed");
static const struct rg_buffer viewed_out = COLOR_BUFFER("viewed out");

static void record_viewport(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_viewport(cmd, &(VkViewport){ .x = 4, .y = 2, .width = 4, .height = 6, .maxDepth = 1 });
    painted_draw(cmd, frame->paints);
}

static const struct rg_pass viewport_rows[] = {
    {
        .name = "draw",
        .color = RG_TARGETS({ &viewed, RG_LOAD_CLEAR }),
        PAINTED_BY(record_viewport, &paint_frag),
    },
    RUN_READ("read", viewed, viewed_out),
};

static void check_viewport(struct run *run)
{
    for (uint32_t i = 0; i < 64; i++)
        painted_check(run, &viewed_out, i,
                      i % 8 >= 4 && i / 8 >= 2 ? painted_color(1, 2, 3, 4)
                                               : painted_color(0, 0, 0, 0));
}

static void viewport_is_set(void **state)
{
    static const struct paint_push paint = { .color = { { 1, 2, 3, 4 } }, ALL };
    PAINTED_VARIANTS(state, viewport_rows, &paint, check_viewport, .outputs = { &viewed_out });
}

/* ---- instances ---- */

static const VkVertexInputAttributeDescription corner = { 0, 0, VK_FORMAT_R32G32_SFLOAT, 0 };
static const VkVertexInputAttributeDescription move = { 3, 1, VK_FORMAT_R32G32_SFLOAT, 8 };
static const struct rg_vertex_layout moves = { 16, 1, &move, VK_VERTEX_INPUT_RATE_INSTANCE, NULL };
static const struct rg_vertex_layout corners = { 8, 1, &corner, .next = &moves };
static const struct rg_image instances = COLOR_IMAGE("instances");
static const struct rg_buffer instances_out = COLOR_BUFFER("instances out");

static const struct rg_pass instance_rows[] = {
    {
        .name = "draw",
        .color = RG_TARGETS({ &instances, RG_LOAD_CLEAR, .blend = RG_BLEND_ADD }),
        .record = record_mesh,
        .vert = &paint_instances_vert,
        .frag = &paint_frag,
        .vertices = &corners,
        .push_size = sizeof(struct paint_push),
    },
    RUN_READ("read", instances, instances_out),
};

/* A column that is two texels wide, three times. */
static void check_instances(struct run *run)
{
    for (uint32_t i = 0; i < 64; i++) {
        const uint32_t x = i % 8;
        const float count = x < 2 ? 2.0F : x >= 6 ? 1.0F : 0.0F;
        painted_check(run, &instances_out, i, painted_color(count, count, count, count));
    }
}

/* Only the second one. */
static void check_one_instance(struct run *run)
{
    for (uint32_t i = 0; i < 64; i++) {
        const float count = i % 8 >= 6 ? 1.0F : 0.0F;
        painted_check(run, &instances_out, i, painted_color(count, count, count, count));
    }
}

static void instances_are_drawn(void **state)
{
    static const float column[][2] = { { -1, -1 }, { -1, 1 }, { -0.5F, 1 }, { -0.5F, -1 } };
    static const uint32_t indices[] = { 0, 1, 2, 0, 2, 3 };
    static const float places[][4] = { { 9, 9, 0, 0 }, { 9, 9, 1.5F, 0 }, { 9, 9, 0, 0 } };
    static const struct paint_push paint = { .color = { { 1, 1, 1, 1 } } };

    const struct {
        VkBufferUsageFlags usage;
        const void *data;
        size_t size;
    } all[] = {
        { VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, column, sizeof(column) },
        { VK_BUFFER_USAGE_INDEX_BUFFER_BIT, indices, sizeof(indices) },
        { VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, places, sizeof(places) },
    };
    struct gpu *gpu = *state;
    struct gpu_buffer buffers[3];
    for (int i = 0; i < 3; i++)
        assert_int_equal(gpu_buffer_create(gpu, &buffers[i], all[i].usage, all[i].data, all[i].size,
                                           "instances"),
                         STATUS_OK);
    struct rg_frame frame = {
        .paints = &paint,
        .mesh = { buffers[0].buffer, buffers[1].buffer, 6, 3, &buffers[2].buffer },
    };
    const struct run_params params = {
        .technique = RG_TECHNIQUE("test", instance_rows),
        .outputs = { &instances_out },
    };
    run_variants(gpu, &params, &frame, check_instances);
    frame.mesh.instance_count = frame.mesh.first_instance = 1;
    run_variants(gpu, &params, &frame, check_one_instance);
    for (int i = 0; i < 3; i++)
        gpu_buffer_destroy(gpu, &buffers[i]);
}

/* ---- specialization constants ---- */

static const struct rg_image special = COLOR_IMAGE("special");
static const struct rg_buffer special_out = COLOR_BUFFER("special out");

/* The vertex shader has none of them. */
static const struct rg_pass special_rows[] = {
    {
        .name = "special",
        .color = RG_TARGETS({ &special, RG_LOAD_DISCARD }),
        .vert = &paint_vert,
        .frag = &constant_frag,
        .push_size = sizeof(struct paint_push),
        .record = painted_record,
    },
    RUN_READ("read special", special, special_out),
};

static void check_defaults(struct run *run)
{
    painted_check_all(run, &special_out, 64, painted_color(0.25F, 5, 0, 1));
}

static void check_special(struct run *run)
{
    painted_check_all(run, &special_out, 64, painted_color(0.25F, 9, 0, 1));
}

static void constants_reach_shaders(void **state)
{
    static const uint32_t values[] = { 8, 9 };
    static const VkSpecializationMapEntry entries[] = {
        { .constantID = 1, .offset = 0, .size = sizeof(values[0]) }, /* nobody's */
        { .constantID = 7, .offset = sizeof(values[0]), .size = sizeof(values[1]) },
    };
    static const VkSpecializationInfo info = { 2, entries, sizeof(values), values };
    static const struct paint_push paints[] = { { ALL } };
    PAINTED_VARIANTS(state, special_rows, paints, check_defaults, .outputs = { &special_out });
    PAINTED_VARIANTS(state, special_rows, paints, check_special, .outputs = { &special_out },
                     .constants = &info);
}

/* ---- views of other formats ---- */

static const struct rg_image codes = { .name = "codes", .format = VK_FORMAT_R8G8B8A8_UNORM };
static const struct rg_image recoded = COLOR_IMAGE("recoded");
static const struct rg_buffer recoded_out = COLOR_BUFFER("recoded out");

static const struct rg_pass view_rows[] = {
    { .name = "codes", .color = RG_TARGETS({ &codes, RG_LOAD_CLEAR }), PAINTED },
    {
        .name = "view",
        .color = RG_TARGETS({ &recoded, RG_LOAD_DISCARD }),
        .uses = RG_USES({ .image = &codes,
                          .access = RG_SAMPLED,
                          .binding = PAINT_SOURCE,
                          .view_format = VK_FORMAT_R8G8B8A8_SNORM }),
        PAINTED_BY(painted_record, &fetch_frag),
    },
    RUN_READ("read recoded", recoded, recoded_out),
};

static void check_recoded(struct run *run)
{
    painted_check_all(run, &recoded_out, FEATURE_TEXELS, painted_color(1, 0, -1 / 127.0F, 0));
}

static void formats_of_views_differ(void **state)
{
    /* bytes 127, 0, 255 and 0 */
    static const struct paint_push paints[] = { { ALL, .color = { { 127 / 255.0F, 0, 1, 0 } } },
                                                { ALL } };
    PAINTED_VARIANTS(state, view_rows, paints, check_recoded, .outputs = { &recoded_out });
}

/* A compute shader stores to an image whose own format does not support storage. */
static const struct rg_image shown = { .name = "shown", .format = VK_FORMAT_R8G8B8A8_SRGB };
static const struct rg_buffer codes_in = { .name = "codes in", .size_per_texel = 4 };

static const struct rg_pass storage_rows[] = {
    {
        .name = "store",
        .kind = RG_COMPUTE,
        .uses =
            RG_USES(FEATURE_SEED,
                    { .image = &shown,
                      .access = RG_STORAGE_WRITE,
                      .binding = DATA_TEXELS,
                      .view_format = VK_FORMAT_R32_UINT },
                    { .buffer = &codes_in, .access = RG_STORAGE_WRITE, .binding = DATA_NUMBERS }),
        .comp = &fill_comp,
        .record = feature_record_texels,
    },
    { .name = "keep", .color = RG_TARGETS({ &shown, RG_LOAD_KEEP }), PAINTED },
    PAINTED_FETCH("decode", shown, recoded),
    RUN_READ("read decoded", recoded, recoded_out),
};

static void begin_stored(struct run *run, uint32_t number, struct rg_frame *frame)
{
    static const struct paint_push paints[] = { { ALL },
                                                { .from = { { 2, 2 } }, .to = { { 3, 3 } } },
                                                { ALL } };
    (void)number;
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ 100 };
    frame->paints = paints;
}

static void check_stored(struct run *run, uint32_t number)
{
    const float *texels = run_data(run, &recoded_out);
    (void)number;
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        const double linear = pow(((100 + i) / 255.0 + 0.055) / 1.055, 2.4);
        CHECK_NEAR(texels[(size_t)4 * i], linear, 0.002);
        CHECK_NEAR(texels[(size_t)4 * i + 1], 0, 0);
    }
}

static void other_formats_are_stored(void **state)
{
    static const struct painted_series series = { 2, begin_stored, check_stored };
    static const struct run_params params = { .technique = RG_TECHNIQUE("test", storage_rows),
                                              .outputs = { &recoded_out } };
    painted_series_variants(*state, &params, &series);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(other_formats_are_stored), ON_DEVICE(formats_of_views_differ),
        ON_DEVICE(depth_is_tested),          ON_DEVICE(targets_are_blended),
        ON_DEVICE(any_blend_is_drawn),       ON_DEVICE(stencil_is_tested),
        ON_DEVICE(faces_are_culled),         ON_DEVICE(mesh_is_drawn),
        ON_DEVICE(mesh_of_a_pool_is_drawn),  ON_DEVICE(viewport_is_set),
        ON_DEVICE(instances_are_drawn),      ON_DEVICE(constants_reach_shaders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
