/*
 * ice_depth.c: depth maps of the ice's front and back faces, and the layers made of them.
 *
 * Seipel and Nivfors 2006, section 3.3: near and far plane enclose the object's bounding sphere, so
 * that the depth buffer spends all its precision on the object. The paper's textures have 512 x 512
 * texels; these have the view's size, as the layers have.
 *
 * Exact for convex objects only: in a concave one, not every point between the nearest front face
 * and the farthest back face is inside.
 */
#include "src/tech/ice/ice_depth.h"
#include "shaders/embedded.h"
#include "shaders/ice/ice_depth.h"
#include "src/tech/frame_resources.h"

const struct rg_image ice_depth_front = {
    .name = "ice_depth.front",
    .format = VK_FORMAT_D32_SFLOAT,
};

const struct rg_image ice_depth_back = {
    .name = "ice_depth.back",
    .format = VK_FORMAT_D32_SFLOAT,
};

/* One image per layer, so that only the requested layers are read back. The thickness is requested
 * most often: it comes first, because unneeded targets are dropped from the end. */
static const struct rg_image layer_images[] = {
    { .name = "ice_depth.thickness", .format = VK_FORMAT_R32_SFLOAT },
    { .name = "ice_depth.front_layer", .format = VK_FORMAT_R32_SFLOAT },
    { .name = "ice_depth.back_layer", .format = VK_FORMAT_R32_SFLOAT },
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
        .color =
            RG_TARGETS({ &layer_images[0], RG_LOAD_CLEAR }, { &layer_images[1], RG_LOAD_CLEAR },
                       { &layer_images[2], RG_LOAD_CLEAR }),
        .uses =
            RG_USES(FRAME_USE_GLOBALS,
                    FRAME_SAMPLE(ice_depth_front, ICE_DEPTH_FRONT, .sampler = &frame_same_texel),
                    FRAME_SAMPLE(ice_depth_back, ICE_DEPTH_BACK, .sampler = &frame_same_texel)),
        .vert = &fullscreen_vert,
        .frag = &ice_depth_frag,
        .record = frame_draw_screen,
    },
};

static const struct frame_layer layers[] = {
    {
        .name = "front.Z",
        .image = &layer_images[1],
        .planes = { "front.Z" },
        .shown = FRAME_SHOWN_DISTANCE,
        .help = "view-space depth of the ice's nearest front face, metres; 0 without ice",
    },
    {
        .name = "back.Z",
        .image = &layer_images[2],
        .planes = { "back.Z" },
        .shown = FRAME_SHOWN_DISTANCE,
        .help = "view-space depth of the ice's farthest back face, metres; 0 without ice",
    },
    {
        .name = "thickness",
        .image = &layer_images[0],
        .planes = { "thickness.Z" },
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "distance between front and back of the ice along the primary ray, metres",
    },
    { 0 },
};

const struct technique ice_depth = {
    .name = "ice_depth",
    .help = "depth maps of the ice's front and back faces, with depth range fitted to the ice",
    .layers = layers,
    .pass_groups = { { PHASE_DEPTHS, .graph = RG_TECHNIQUE("ice_depth", passes) } },
};
