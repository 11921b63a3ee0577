/*
 * gbuffer.c: normal, position and depth of the nearest surface: the layers N, P and Z.
 *
 * Both rows draw into the same targets with a depth of their own, so that these layers can be had
 * without a picture.
 */
#include "src/tech/gbuffer.h"
#include "shaders/embedded.h"
#include "src/frame.h"

const struct rg_image gbuffer_normal = {
    .name = "gbuffer.normal",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

const struct rg_image gbuffer_position = {
    .name = "gbuffer.position",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

static const struct rg_image gbuffer_depth = {
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
        .color[0] = { &gbuffer_normal, RG_LOAD_CLEAR },
        .color[1] = { &gbuffer_position, RG_LOAD_CLEAR, NOTHING },
        .depth = { &gbuffer_depth, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = RG_USES(FRAME_USE_GLOBALS),
        .vert = &gbuffer_vert,
        .frag = &gbuffer_frag,
        .vertices = &frame_mesh_layout,
        .record = frame_draw_surroundings,
    },
    {
        .name = "gbuffer.object",
        .color[0] = { &gbuffer_normal, RG_LOAD_KEEP },
        .color[1] = { &gbuffer_position, RG_LOAD_KEEP },
        .depth = { &gbuffer_depth, RG_LOAD_KEEP },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = RG_USES(FRAME_USE_GLOBALS),
        .vert = &gbuffer_vert,
        .frag = &gbuffer_frag,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_BACK_BIT,
        .record = frame_draw_object,
    },
};

const struct technique gbuffer = {
    .graph = RG_TECHNIQUE("gbuffer", passes),
    .help = "normal, position and depth of the nearest surface",
};
