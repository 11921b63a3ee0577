/*
 * gbuffer.c: normal, position and depth of the nearest surface: the layers N, P and Z.
 *
 * Both rows draw into the same targets with a depth of their own, so that these layers can be had
 * without a picture.
 */
#include "src/tech/gbuffer.h"
#include "shaders/embedded.h"
#include "shaders/gbuffer.h"
#include "src/tech/frame.h"

static rg_record_fn record_surroundings, record_object;

const struct rg_image gbuffer_normal = {
    .name = "gbuffer.normal",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

const struct rg_image gbuffer_position = {
    .name = "gbuffer.position",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

const struct rg_image gbuffer_depth = {
    .name = "gbuffer.depth",
    .format = VK_FORMAT_D32_SFLOAT,
};

#define NOTHING \
    { \
        .color.float32 = { 0.0f, 0.0f, 0.0f, GBUFFER_NOTHING } \
    }

static const struct rg_pass passes[] = {
    {
        .name = "gbuffer.surroundings",
        .color = RG_TARGETS({ &gbuffer_normal, RG_LOAD_CLEAR },
                            { &gbuffer_position, RG_LOAD_CLEAR, NOTHING }),
        .depth = { &gbuffer_depth, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = RG_USES(FRAME_USE_GLOBALS),
        .vert = &gbuffer_vert,
        .frag = &gbuffer_frag,
        .vertices = &frame_mesh_layout,
        .push_size = sizeof(struct gbuffer_push),
        .record = record_surroundings,
    },
    {
        .name = "gbuffer.object",
        .color = RG_TARGETS({ &gbuffer_normal, RG_LOAD_KEEP }, { &gbuffer_position, RG_LOAD_KEEP }),
        .depth = { &gbuffer_depth, RG_LOAD_KEEP },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = RG_USES(FRAME_USE_GLOBALS),
        .vert = &gbuffer_vert,
        .frag = &gbuffer_frag,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_BACK_BIT,
        .push_size = sizeof(struct gbuffer_push),
        .record = record_object,
    },
};

static void record_surroundings(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &(struct gbuffer_push){ 0 }, sizeof(struct gbuffer_push));
    rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

static void record_object(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, &(struct gbuffer_push){ .object = 1 }, sizeof(struct gbuffer_push));
    rg_cmd_draw_mesh(cmd, &frame->object);
}

const struct technique gbuffer = {
    .graph = RG_TECHNIQUE("gbuffer", passes),
    .help = "normal, position and depth of the nearest surface",
};
