/*
 * ice_depth.c: depth of the ice's front and back faces.
 *
 * Seipel and Nivfors 2006, section 3.3: the near plane at the front, the far plane at the back of
 * the object's bounding sphere, so that the depth buffer spends all its precision on the object.
 * The paper's textures are 512 x 512; these are of the view's size, as the layers are.
 *
 * Convex objects only: of a concave one, what lies between the nearest front face and the farthest
 * back face is not all inside.
 */
#include "src/tech/ice_depth.h"
#include "shaders/embedded.h"
#include "shaders/ice_depth.h"
#include "src/frame.h"

static rg_record_fn record_layers;

const struct rg_image ice_depth_front = {
    .name = "ice_depth.front",
    .format = VK_FORMAT_D32_SFLOAT,
};

const struct rg_image ice_depth_back = {
    .name = "ice_depth.back",
    .format = VK_FORMAT_D32_SFLOAT,
};

const struct rg_image ice_depth_layers = {
    .name = "ice_depth.layers",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

static const struct rg_pass passes[] = {
    {
        .name = "ice_depth.front",
        .depth = { &ice_depth_front, RG_LOAD_CLEAR, { .depthStencil = { 1.0f, 0 } } },
        .depth_compare = VK_COMPARE_OP_LESS,
        .uses = RG_USES(FRAME_USE_GLOBALS),
        .vert = &ice_depth_vert,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_BACK_BIT,
        .record = frame_draw_object,
    },
    {
        .name = "ice_depth.back",
        .depth = { &ice_depth_back, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = RG_USES(FRAME_USE_GLOBALS),
        .vert = &ice_depth_vert,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_FRONT_BIT,
        .record = frame_draw_object,
    },
    {
        .name = "ice_depth.layers",
        .color = RG_TARGETS({ &ice_depth_layers, RG_LOAD_DISCARD }),
        .uses = RG_USES(FRAME_USE_GLOBALS,
                        { .image = &ice_depth_front,
                          .access = RG_SAMPLED,
                          .binding = ICE_DEPTH_FRONT,
                          .same_texel = true },
                        { .image = &ice_depth_back,
                          .access = RG_SAMPLED,
                          .binding = ICE_DEPTH_BACK,
                          .same_texel = true }),
        .vert = &screen_vert,
        .frag = &ice_depth_frag,
        .record = record_layers,
    },
};

static void record_layers(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw(cmd, 3);
}

const struct technique ice_depth = {
    .graph = RG_TECHNIQUE("ice_depth", passes),
    .help = "depth of the ice's front and back faces, fitted to it",
};
