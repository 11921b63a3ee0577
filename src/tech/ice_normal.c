/*
 * ice_normal.c: world normals and depth of the back faces, and of the front faces.
 *
 * Seipel and Nivfors 2006, section 3.2: rendered to a floating-point texture of the window's size,
 * interpolated and normalised. Of several back faces behind each other the nearest counts: it is
 * where a ray that enters a convex part leaves it. The front faces are for rungs that follow light
 * back to them; surroundings in front of the ice hide none of either.
 *
 * Normals are set to none where shaders may look them up, by a draw: llvmpipe clears what has more
 * than four bytes a texel by a call for each.
 */
#include "src/tech/ice_normal.h"
#include "shaders/embedded.h"
#include "src/tech/bump.h"
#include "src/tech/frame.h"
#include "src/tech/refract.h"

const struct rg_image ice_normal_back = {
    .name = "ice_normal.back",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image ice_normal_back_depth = {
    .name = "ice_normal.back_depth",
    .format = VK_FORMAT_D32_SFLOAT,
};

const struct rg_image ice_normal_front = {
    .name = "ice_normal.front",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image ice_normal_shading = {
    .name = "ice_normal.shading",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

const struct rg_image ice_normal_front_depth = {
    .name = "ice_normal.front_depth",
    .format = VK_FORMAT_R32_SFLOAT,
};

/* In a pool. */
static const struct rg_image front_test = {
    .name = "ice_normal.front_test",
    .format = VK_FORMAT_D32_SFLOAT,
};

#define NO(what, target) \
    { \
        .name = "ice_normal.no_" what, .color = RG_TARGETS({ &(target), RG_LOAD_DISCARD }), \
        .vert = &screen_vert, .frag = &nothing_frag, .record = frame_draw_lookup_area, \
    }

#define BACK \
    NO("back", ice_normal_back), \
    { \
        .name = "ice_normal.back", .color = RG_TARGETS({ &ice_normal_back, RG_LOAD_KEEP }), \
        .depth = { &ice_normal_back_depth, RG_LOAD_CLEAR }, /* 0 is infinity */ \
            .depth_compare = VK_COMPARE_OP_GREATER, .uses = RG_USES(FRAME_USE_GLOBALS), \
        .vert = &ice_normal_vert, .frag = &ice_normal_frag, .vertices = &frame_mesh_layout, \
        .cull = VK_CULL_MODE_FRONT_BIT, .record = frame_draw_object, \
    }

#define FRONT(depth_image, ...) \
    NO("front", ice_normal_front), \
    { \
        .name = "ice_normal.front", \
        .color = RG_TARGETS({ &ice_normal_front, RG_LOAD_KEEP }, \
                            { &ice_normal_front_depth, RG_LOAD_CLEAR }, \
                            { &ice_normal_shading, RG_LOAD_DISCARD }), \
        .depth = { &(depth_image), RG_LOAD_CLEAR }, .depth_compare = VK_COMPARE_OP_GREATER, \
        .record = frame_draw_object, __VA_ARGS__, \
    }

#define SMOOTH REFRACT_FRONT_FACES, .frag = &ice_front_frag, .uses = RG_USES(FRAME_USE_GLOBALS)

static const struct rg_pass passes[] = {
    BACK,
    FRONT(background_depth, SMOOTH),
};

static const struct rg_pass passes_with_bumps[] = {
    BACK,
    FRONT(background_depth, REFRACT_BUMPED_FACES, .frag = &ice_front_bump_frag,
          .uses = RG_USES(FRAME_USE_GLOBALS, BUMP_USE_MAP)),
};

static const struct rg_pass passes_of_pool[] = {
    BACK,
    FRONT(front_test, SMOOTH),
};

const struct technique ice_normal = {
    .graph = RG_TECHNIQUE("ice_normal", passes),
    .help = "outward normals and depth of the ice's faces",
};

const struct technique ice_normal_with_bumps = {
    .graph = RG_TECHNIQUE("ice_normal", passes_with_bumps),
    .help = "the same with bumps",
};

const struct technique ice_normal_of_pool = {
    .graph = RG_TECHNIQUE("ice_normal", passes_of_pool),
    .help = "the same of ice that floats",
};
