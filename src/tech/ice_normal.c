/*
 * ice_normal.c: world normals and depth of the back faces, and of the front faces.
 *
 * Seipel and Nivfors 2006, section 3.2: rendered to a floating-point texture of the window's size,
 * interpolated and normalised. Of several back faces behind each other the nearest counts: it is
 * where a ray that enters a convex part leaves it. The front faces are for rungs that trace light
 * back to them. Surroundings in front of the ice do not hide its faces here.
 *
 * A draw resets the normals where shaders may look them up, not a clear: llvmpipe clears formats of
 * more than four bytes a texel with a function call for each texel.
 */
#include "src/tech/ice_normal.h"
#include "shaders/embedded.h"
#include "src/tech/bump.h"
#include "src/tech/frame.h"
#include "src/tech/pool.h"
#include "src/tech/row_builder.h"

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

/* Replaces frame_depth where that is kept. */
static const struct rg_image front_test = {
    .name = "ice_normal.front_test",
    .format = VK_FORMAT_D32_SFLOAT,
};

static const struct rg_use smooth_uses[] = { FRAME_USE_GLOBALS, { 0 } };
static const struct rg_use bumped_uses[] = { FRAME_USE_GLOBALS, BUMP_USE_MAP, { 0 } };

enum {
    FRONT_ROW = 3 /* index in `passes` */
};

static const struct rg_pass passes[] = {
    {
        .name = "ice_normal.no_back",
        .color = RG_TARGETS({ &ice_normal_back, RG_LOAD_DISCARD }),
        .vert = &screen_vert,
        .frag = &nothing_frag,
        .record = frame_draw_lookup_area,
    },
    {
        .name = "ice_normal.back",
        .color = RG_TARGETS({ &ice_normal_back, RG_LOAD_KEEP }),
        .depth = { &ice_normal_back_depth, RG_LOAD_CLEAR }, /* to 0: infinity */
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = smooth_uses,
        .vert = &ice_normal_vert,
        .frag = &ice_normal_frag,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_FRONT_BIT,
        .record = frame_draw_object,
    },
    {
        .name = "ice_normal.no_front",
        .color = RG_TARGETS({ &ice_normal_front, RG_LOAD_DISCARD }),
        .vert = &screen_vert,
        .frag = &nothing_frag,
        .record = frame_draw_lookup_area,
    },
    {
        .name = "ice_normal.front",
        .color = RG_TARGETS({ &ice_normal_front, RG_LOAD_KEEP },
                            { &ice_normal_front_depth, RG_LOAD_CLEAR },
                            { &ice_normal_shading, RG_LOAD_DISCARD }),
        .depth = { &frame_depth, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_BACK_BIT,
        .record = frame_draw_object,
    },
};

/* Whether frame_depth is not for the front faces: it has a finished picture, or that of other
 * objects, of which rungs that draw faces are the ones to add to it. */
static bool keeps_depth(const struct technique_choice *choice)
{
    const bool are_many = choice->object_count > 1;
    return choice->has_pool || choice->keeps_depth || (are_many && !choice->rung->rung.by_pixel);
}

/* In a pool the rows are drawn after the background, keep its depth, and show no bumps. */
static struct rg_technique make_rows(const struct technique_choice *choice,
                                     struct row_builder *builder)
{
    const bool bumped = !choice->has_pool && bump.is_on(choice->settings);
    const size_t count = sizeof(passes) / sizeof(passes[0]);
    struct rg_pass *rows = row_builder_rows(builder, passes, count);
    if (!rows || (choice->has_pool && !pool_has_ice(choice->settings)))
        return (struct rg_technique){ 0 };
    rows[FRONT_ROW].vert = bumped ? &refract_bump_vert : &refract_vert;
    rows[FRONT_ROW].frag = bumped ? &ice_front_bump_frag : &ice_front_frag;
    rows[FRONT_ROW].uses = bumped ? bumped_uses : smooth_uses;
    if (keeps_depth(choice))
        rows[FRONT_ROW].depth.image = &front_test;
    return (struct rg_technique){ "ice_normal", rows, count };
}

static const struct frame_layer layers[] = {
    {
        .name = "back.N",
        .image = &ice_normal_back,
        .planes = { "back.N.X", "back.N.Y", "back.N.Z" },
        .shown = FRAME_SHOWN_DIRECTION,
        .help = "outward world normal of the ice's back face",
    },
    { 0 },
};

const struct technique ice_normal = {
    .name = "ice_normal",
    .help = "outward normals and depth of the ice's faces",
    .parts = { { PHASE_NORMALS, SCENE_OF_ANY, .rows = make_rows } },
    .layers = layers,
};
