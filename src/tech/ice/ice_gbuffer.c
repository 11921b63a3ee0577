/*
 * ice_gbuffer.c: G-buffers of the ice: normals, depth and surface parameters of its faces.
 *
 * Seipel and Nivfors 2006, section 3.2: normals in a floating-point texture of the window's size,
 * interpolated and normalised. Of several back faces the nearest counts: there a ray leaves the
 * convex part that it entered. Front faces are for refraction models that trace light back to them.
 * Surroundings in front of the ice do not hide its faces here.
 *
 * Normals are reset by a draw limited to where shaders may look them up, not by a clear: llvmpipe
 * clears formats of more than four bytes per texel with a function call for each texel.
 */
#include "src/tech/ice/ice_gbuffer.h"
#include "shaders/embedded.h"
#include "shaders/ice/ice_textured.h"
#include "src/tech/frame_resources.h"
#include "src/tech/lighting/bump.h"
#include "src/tech/pass_arena.h"
#include "src/tech/water/pool_parameters.h"

static rg_record_fn record_textured;

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

const struct rg_image ice_normal_front_material = {
    .name = "ice_normal.front_material",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image ice_normal_back_material = {
    .name = "ice_normal.back_material",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image ice_normal_front_base = {
    .name = "ice_normal.front_base",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image ice_normal_wide_back = {
    .name = "ice_normal.wide_back",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .scale = ICE_NORMAL_WIDE,
};

const struct rg_image ice_normal_wide_back_depth = {
    .name = "ice_normal.wide_back_depth",
    .format = VK_FORMAT_D32_SFLOAT,
    .scale = ICE_NORMAL_WIDE,
};

const struct rg_image ice_normal_wide_front = {
    .name = "ice_normal.wide_front",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .scale = ICE_NORMAL_WIDE,
};

const struct rg_image ice_normal_wide_front_depth = {
    .name = "ice_normal.wide_front_depth",
    .format = VK_FORMAT_D32_SFLOAT,
    .scale = ICE_NORMAL_WIDE,
};

/* depth buffer of the front faces, used if the content of frame_depth must be kept */
static const struct rg_image front_test = {
    .name = "ice_normal.front_test",
    .format = VK_FORMAT_D32_SFLOAT,
};

static const struct rg_use plain_uses[] = { FRAME_USE_GLOBALS, { 0 } };
static const struct rg_use bumped_uses[] = { FRAME_USE_GLOBALS, BUMP_USE_MAP, { 0 } };

enum {
    BACK_PASS = 1, /* indices in `passes` */
    FRONT_PASS = 3,
    WIDE_PASS = 4,
    PASS_COUNT = 6,
};

#define WIDE_ROW_OF(side, culled) \
    { \
        .name = "ice_normal.wide_" #side, \
        .color = RG_TARGETS({ &ice_normal_wide_##side, RG_LOAD_CLEAR }), \
        .depth = { &ice_normal_wide_##side##_depth, RG_LOAD_CLEAR }, \
        .depth_compare = VK_COMPARE_OP_GREATER, .uses = plain_uses, .vert = &ice_normal_wide_vert, \
        .frag = &ice_normal_frag, .vertices = &frame_mesh_layout, .cull = (culled), \
        .record = frame_draw_object, \
    }

static const struct rg_pass passes[] = {
    {
        .name = "ice_normal.clear_back",
        .color = RG_TARGETS({ &ice_normal_back, RG_LOAD_DISCARD }),
        .vert = &fullscreen_vert,
        .frag = &clear_frag,
        .record = frame_draw_lookup_area,
    },
    {
        .name = "ice_normal.back",
        .color = RG_TARGETS({ &ice_normal_back, RG_LOAD_KEEP }),
        .depth = { &ice_normal_back_depth, RG_LOAD_CLEAR }, /* cleared to 0: infinity */
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = plain_uses,
        .vert = &ice_normal_vert,
        .frag = &ice_normal_frag,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_FRONT_BIT,
        .record = frame_draw_object,
    },
    {
        .name = "ice_normal.clear_front",
        .color = RG_TARGETS({ &ice_normal_front, RG_LOAD_DISCARD }),
        .vert = &fullscreen_vert,
        .frag = &clear_frag,
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
    WIDE_ROW_OF(back, VK_CULL_MODE_FRONT_BIT),
    WIDE_ROW_OF(front, VK_CULL_MODE_BACK_BIT),
};

#define CLEAR_TO_ONE \
    RG_LOAD_CLEAR, \
    { \
        .color.float32 = { 1.0f, 1.0f, 1.0f, 0.0f } \
    }

static const struct rg_target textured_backs[] = {
    { &ice_normal_back, RG_LOAD_KEEP },
    { &ice_normal_back_material, CLEAR_TO_ONE },
};

static const struct rg_target textured_fronts[] = {
    { &ice_normal_front, RG_LOAD_KEEP },       { &ice_normal_front_depth, RG_LOAD_CLEAR },
    { &ice_normal_shading, RG_LOAD_DISCARD },  { &ice_normal_front_material, CLEAR_TO_ONE },
    { &ice_normal_front_base, RG_LOAD_CLEAR },
};

#define TEXTURE_USES \
    FRAME_USE_GLOBALS, \
        FRAME_SAMPLE(frame_textures, SURROUNDINGS_TEXTURES, .sampler = &frame_texture_sampler), \
        FRAME_SAMPLE(frame_data_textures, SURROUNDINGS_DATA_TEXTURES, \
                     .sampler = &frame_texture_sampler), \
        FRAME_SAMPLE(frame_materials, SURROUNDINGS_MATERIALS, .sampler = NULL)

static const struct rg_use back_uses[] = { TEXTURE_USES, { 0 } };
static const struct rg_use front_uses[] = {
    TEXTURE_USES,
    FRAME_SAMPLE(frame_surface_light, SURROUNDINGS_ENVIRONMENT_LIGHT,
                 .sampler = &frame_environment_sampler),
    FRAME_SAMPLE(frame_lights, SURROUNDINGS_LIGHTS, .sampler = NULL),
    { 0 },
};

bool ice_gbuffer_has_materials(const struct technique_config *config)
{
    const struct technique *refraction = config->refraction;
    return refraction && refraction->refraction.shaders && !refraction->refraction.traces_bvh &&
           scene_has_textured_objects(config->scene) && !bump.is_on(config->settings);
}

/* Makes a G-buffer pass evaluate the textures of an object's material. */
static void texture_pass(struct rg_pass *pass, bool is_front)
{
    pass->color = is_front ? textured_fronts : textured_backs;
    pass->color_count = is_front ? 5 : 2;
    pass->vert = &ice_textured_vert;
    pass->frag = is_front ? &ice_material_front_frag : &ice_material_back_frag;
    pass->uses = is_front ? front_uses : back_uses;
    pass->push_size = sizeof(struct ice_material_push);
    pass->record = record_textured;
}

static void record_textured(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct model *model = &frame->scene->model;
    const struct object *object = frame_object_of(cmd, frame);
    const struct material *m = &model->materials[object->material];
    const uint32_t vertex = model->object.indices[object->first_index];
    const uint32_t bits = model->object.vertices[vertex].material;
    const struct ice_material_push push = {
        .parameters = { m->base_color, m->roughness, 1.0f - m->transmission },
        .row = object->material + 1,
        .layer = bits & MESH_TEXTURE_MASK,
    };
    rg_cmd_push(cmd, &push, sizeof(push));
    frame_draw_object(cmd, frame);
}

/* Returns true if front faces need their own depth buffer. frame_depth then holds the depths
 * of other objects or of a finished image, which the G-buffer passes must not change. */
static bool keeps_depth(const struct technique_config *config)
{
    const bool are_many = config->object_count > 1;
    return config->scene->has_pool || config->keeps_depth ||
           (are_many && !config->refraction->refraction.shades_fullscreen);
}

/* Makes a pass clear its normals on load. In a limited area this is faster than a clear pass. */
static void clear_normals(struct pass_arena *builder, struct rg_pass *pass)
{
    struct rg_target *color = pass_arena_copy_targets(builder, pass->color, pass->color_count);
    if (color)
        color->load = RG_LOAD_CLEAR;
    pass->color = color;
}

/* Returns the G-buffer passes, without bump mapping in scenes with a pool. */
static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    const bool bumped = !config->scene->has_pool && bump.is_on(config->settings);
    const size_t count = config->is_wide ? PASS_COUNT : WIDE_PASS;
    struct rg_pass *copies = pass_arena_copy_passes(builder, passes, count);
    if (!copies || (config->scene->has_pool && !pool_has_ice(config->settings)))
        return (struct rg_technique){ 0 };
    copies[FRONT_PASS].vert = bumped ? &refract_bump_vert : &refract_vert;
    copies[FRONT_PASS].frag = bumped ? &ice_gbuffer_front_bump_frag : &ice_gbuffer_front_frag;
    copies[FRONT_PASS].uses = bumped ? bumped_uses : plain_uses;
    if (ice_gbuffer_has_materials(config)) {
        texture_pass(&copies[BACK_PASS], false);
        texture_pass(&copies[FRONT_PASS], true);
    }
    if (keeps_depth(config))
        copies[FRONT_PASS].depth.image = &front_test;
    if (config->is_limited) {
        clear_normals(builder, &copies[BACK_PASS]);
        clear_normals(builder, &copies[FRONT_PASS]);
        copies[0] = copies[BACK_PASS];
        copies[1] = copies[FRONT_PASS];
        return (struct rg_technique){ "ice_normal", copies, 2 };
    }
    return (struct rg_technique){ "ice_normal", copies, count };
}

/* Returns a pass that draws the back faces of all objects for the AOV layer back.N. The refraction
 * passes cannot provide it, because their image keeps only the last object's faces. */
static struct rg_technique make_layer(const struct technique_config *config,
                                      struct pass_arena *builder)
{
    const bool are_many = config->object_count > 1 && config->refraction &&
                          !config->refraction->refraction.traces_bvh;
    struct rg_pass *pass = are_many ? pass_arena_copy_passes(builder, &passes[BACK_PASS], 1) : NULL;
    if (!pass)
        return (struct rg_technique){ 0 };
    pass->name = "ice_normal.all_back";
    if (ice_gbuffer_has_materials(config))
        texture_pass(pass, false);
    clear_normals(builder, pass);
    return (struct rg_technique){ "ice_normal", pass, 1 };
}

static const struct frame_layer layers[] = {
    {
        .name = "back.N",
        .image = &ice_normal_back,
        .planes = { "back.N.X", "back.N.Y", "back.N.Z" },
        .shown = FRAME_SHOWN_DIRECTION,
        .help = "outward world-space normal of the ice's nearest back face",
    },
    { 0 },
};

const struct technique ice_gbuffer = {
    .name = "ice_normal",
    .help = "G-buffers of the ice: outward normals and depth of front and back faces",
    .pass_groups = { { PHASE_NORMALS, SCENE_OF_ANY, .make_passes = make_passes },
                     { PHASE_FACES, SCENE_OF_ANY, .make_passes = make_layer } },
    .layers = layers,
};
