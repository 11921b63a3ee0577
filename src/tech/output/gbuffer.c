/*
 * gbuffer.c: G-buffer of the visible surface: normal, depth and object (layers N, Z and object;
 * layers P, distance and N.camera are computed from them).
 *
 * The first two passes draw into the same targets and have a depth buffer of their own, so that
 * these layers can be rendered without the beauty image. Alpha cut-outs, and blended surfaces with
 * alpha below one half, show what is behind them.
 */
#include "src/tech/output/gbuffer.h"
#include "shaders/embedded.h"
#include "src/tech/frame_resources.h"

static rg_record_fn record_surroundings, record_objects;

const struct rg_image gbuffer_normal = {
    .name = "gbuffer.normal",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

const struct rg_image gbuffer_object = {
    .name = "gbuffer.object",
    .format = VK_FORMAT_R32_SFLOAT,
};

/* xyz: world-space position, metres; w: distance from the camera, metres, or GBUFFER_NOTHING */
static const struct rg_image surface_position = {
    .name = "gbuffer.position",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

static const struct rg_image camera_normal = {
    .name = "gbuffer.camera_normal",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

const struct rg_image gbuffer_depth = {
    .name = "gbuffer.depth",
    .format = VK_FORMAT_D32_SFLOAT,
};

/* Imported: model.surroundings_starts, as filterable bytes of 32-bit numbers. */
static const struct rg_image gbuffer_starts =
    FRAME_IMPORTED("gbuffer.starts", VK_FORMAT_R8G8B8A8_UNORM, false);

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(frame_textures, SURROUNDINGS_TEXTURES, .sampler = &frame_texture_sampler),
    FRAME_SAMPLE(frame_materials, SURROUNDINGS_MATERIALS, .sampler = NULL),
    FRAME_SAMPLE(gbuffer_starts, GBUFFER_STARTS, .sampler = NULL,
                 .stages = VK_SHADER_STAGE_VERTEX_BIT),
    { 0 },
};

static const struct rg_pass passes[] = {
    {
        .name = "gbuffer.surroundings",
        .color = RG_TARGETS({ &gbuffer_normal,
                              RG_LOAD_CLEAR,
                              { .color.float32 = { 0.0f, 0.0f, 0.0f, GBUFFER_NOTHING } } },
                            { &gbuffer_object, RG_LOAD_CLEAR }),
        .depth = { &gbuffer_depth, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = uses,
        .vert = &gbuffer_vert,
        .frag = &gbuffer_frag,
        .vertices = &frame_mesh_layout,
        .push_size = sizeof(struct gbuffer_push),
        .record = record_surroundings,
    },
    {
        .name = "gbuffer.objects",
        .color = RG_TARGETS({ &gbuffer_normal, RG_LOAD_KEEP }, { &gbuffer_object, RG_LOAD_KEEP }),
        .depth = { &gbuffer_depth, RG_LOAD_KEEP },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = uses,
        .vert = &gbuffer_vert,
        .frag = &gbuffer_frag,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_BACK_BIT,
        .push_size = sizeof(struct gbuffer_push),
        .record = record_objects,
    },
};

/* Drawn after the water's passes, which share the G-buffer. */
static const struct rg_pass derived_passes[] = {
    {
        .name = "gbuffer.position",
        .color = RG_TARGETS({ &surface_position, RG_LOAD_DISCARD }),
        .uses = RG_USES(FRAME_USE_GLOBALS,
                        FRAME_SAMPLE(gbuffer_normal, GBUFFER_NORMAL, .sampler = &frame_same_texel)),
        .vert = &fullscreen_vert,
        .frag = &gbuffer_position_frag,
        .record = frame_draw_screen,
    },
    {
        .name = "gbuffer.camera_normal",
        .color = RG_TARGETS({ &camera_normal, RG_LOAD_DISCARD }),
        .uses = RG_USES(FRAME_USE_GLOBALS,
                        FRAME_SAMPLE(gbuffer_normal, GBUFFER_NORMAL, .sampler = &frame_same_texel)),
        .vert = &fullscreen_vert,
        .frag = &gbuffer_camera_normal_frag,
        .record = frame_draw_screen,
    },
};

static void record_surroundings(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct model *model = &frame->scene->model;
    const struct gbuffer_push push = {
        .id = model->object_count + 1,
        .count = model->surroundings_object_count,
    };
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

/* Draws each object with its number. A mesh without a list of objects is object 1. */
static void record_objects(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct model *model = &frame->scene->model;
    const uint32_t count = model->object_count ? model->object_count : 1;
    for (uint32_t i = 0; i < count; i++) {
        const struct gbuffer_push push = { .id = i + 1, .object = 1 };
        rg_cmd_push(cmd, &push, sizeof(push));
        if (model->object_count)
            rg_cmd_draw_mesh_part(cmd, &frame->object, model->objects[i].first_index,
                                  model->objects[i].index_count);
        else
            rg_cmd_draw_mesh(cmd, &frame->object);
    }
}

_Static_assert(MODEL_SURROUNDINGS_ROW == GBUFFER_STARTS_WIDTH, "rows of starts are rows of texels");

static struct technique_texels find_starts(const struct scene *scene)
{
    if (!scene->model.surroundings_object_count)
        return (struct technique_texels){ 0 };
    return (struct technique_texels){
        .texels = scene->model.surroundings_starts,
        .width = MODEL_SURROUNDINGS_ROW,
        .height = (scene->model.surroundings_object_count - 1) / MODEL_SURROUNDINGS_ROW + 1,
        .no_mips = true,
    };
}

static const uint32_t no_start;

static const struct technique_import imports[] = {
    { &gbuffer_starts, find_starts, &no_start },
    { 0 },
};

static const struct frame_layer layers[] = {
    {
        .name = "Z",
        .image = &gbuffer_normal,
        .planes = { "Z" },
        .first_channel = 3,
        .shown = FRAME_SHOWN_DISTANCE,
        .help =
            "distance of the visible surface along the view axis, metres; 1e10 if there is none",
    },
    {
        .name = "N",
        .image = &gbuffer_normal,
        .planes = { "N.X", "N.Y", "N.Z" },
        .shown = FRAME_SHOWN_DIRECTION,
        .help = "world-space normal of the visible surface",
    },
    {
        .name = "P",
        .image = &surface_position,
        .planes = { "P.X", "P.Y", "P.Z" },
        .shown = FRAME_SHOWN_POSITION,
        .help = "position of the visible surface, metres (of models far from 0,0,0: from "
                "firn/origin)",
    },
    {
        .name = "object",
        .image = &gbuffer_object,
        .planes = { "object.Z" },
        .integer = true,
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "number of the first visible surface's object (names: firn/objects), 0 if there is "
                "none",
    },
    {
        .name = "distance",
        .image = &surface_position,
        .planes = { "distance.Z" },
        .first_channel = 3,
        .shown = FRAME_SHOWN_DISTANCE,
        .help = "distance of the visible surface from the camera, metres; 1e10 if there is none",
    },
    {
        .name = "N.camera",
        .image = &camera_normal,
        .planes = { "N.camera.X", "N.camera.Y", "N.camera.Z" },
        .shown = FRAME_SHOWN_DIRECTION,
        .help = "normal of the visible surface along the camera's axes: right, down, forward; 0 if "
                "there is none",
    },
    { 0 },
};

const struct technique gbuffer = {
    .name = "gbuffer",
    .help = "normal, position, depth and object of the nearest surface",
    .layers = layers,
    .imports = imports,
    .pass_groups = { { PHASE_SURFACES, SCENE_OF_ANY, .graph = RG_TECHNIQUE("gbuffer", passes) },
                     { PHASE_UNPACK, SCENE_OF_ANY,
                       .graph = RG_TECHNIQUE("gbuffer", derived_passes) } },
};
