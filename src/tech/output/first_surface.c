/*
 * first_surface.c: albedo and motion layers (AOVs) of the first visible surface. Holes cut by alpha
 * testing are invisible, and so are blended surfaces with alpha below one half. Motion vectors
 * follow the surface, not reflected or refracted objects.
 */
#include "src/tech/output/first_surface.h"
#include "shaders/embedded.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/technique.h"

static rg_record_fn record_surroundings, record_objects;

static const struct rg_image first_surface_albedo = {
    .name = "first_surface.albedo",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

static const struct rg_image first_surface_motion = {
    .name = "first_surface.motion",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
};

static const struct rg_image first_surface_depth = {
    .name = "first_surface.depth",
    .format = VK_FORMAT_D32_SFLOAT,
};

/* Imported vertex positions of an animated model in the previous frame. */
static const struct rg_image first_surface_positions =
    FRAME_IMPORTED("first_surface.positions", VK_FORMAT_R32G32B32A32_SFLOAT, false);

static const struct rg_buffer first_surface_previous = {
    .name = "first_surface.previous",
    .size = sizeof(struct first_surface_previous),
    .memory = RG_MEMORY_UPLOAD,
};

static const struct rg_use uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(frame_textures, SURROUNDINGS_TEXTURES, .sampler = &frame_texture_sampler),
    FRAME_SAMPLE(frame_materials, SURROUNDINGS_MATERIALS, .sampler = NULL),
    FRAME_SAMPLE(first_surface_positions, FIRST_SURFACE_POSITIONS, .sampler = NULL,
                 .stages = VK_SHADER_STAGE_VERTEX_BIT),
    { .buffer = &first_surface_previous, .access = RG_UNIFORM, .binding = FIRST_SURFACE_PREVIOUS },
    { 0 },
};

static const struct rg_pass passes[] = {
    {
        .name = "first_surface.surroundings",
        .color = RG_TARGETS({ &first_surface_albedo, RG_LOAD_CLEAR },
                            { &first_surface_motion, RG_LOAD_CLEAR }),
        .depth = { &first_surface_depth, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = uses,
        .vert = &first_surface_vert,
        .frag = &first_surface_frag,
        .vertices = &frame_mesh_layout,
        .push_size = sizeof(struct first_surface_push),
        .record = record_surroundings,
    },
    {
        .name = "first_surface.objects",
        .color = RG_TARGETS({ &first_surface_albedo, RG_LOAD_KEEP },
                            { &first_surface_motion, RG_LOAD_KEEP }),
        .depth = { &first_surface_depth, RG_LOAD_KEEP },
        .depth_compare = VK_COMPARE_OP_GREATER,
        .uses = uses,
        .vert = &first_surface_vert,
        .frag = &first_surface_frag,
        .vertices = &frame_mesh_layout,
        .cull = VK_CULL_MODE_BACK_BIT,
        .push_size = sizeof(struct first_surface_push),
        .record = record_objects,
    },
};

static void record_surroundings(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct first_surface_push push = { .first = frame->scene->model.object.vertex_count };
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw_mesh(cmd, &frame->surroundings);
}

static void record_objects(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct first_surface_push push = { .object = 1 };
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw_mesh(cmd, &frame->object);
}

void first_surface_write(void *memory, const struct frame_view *view, const struct globals *globals)
{
    struct first_surface_previous *earlier = memory;
    *earlier = (struct first_surface_previous){
        .clip_from_world = view->previous_clip_from_world,
        .world_from_object = globals->world_from_object,
        .world_from_movers = globals->world_from_movers,
        .half_size = { { 0.5f * (float)view->width, 0.5f * (float)view->height } },
    };
    frame_rotations(view, globals->center, frame_time_before(view->settings, view->time),
                    &earlier->world_from_object, &earlier->world_from_movers);
}

static const struct technique_upload uploads[] = {
    { &first_surface_previous, first_surface_write },
    { 0 },
};

uint32_t first_surface_rows(const struct model *model)
{
    const size_t count = (size_t)model->object.vertex_count + model->surroundings.vertex_count;
    return (uint32_t)(count / FIRST_SURFACE_WIDTH + 1);
}

static struct technique_texels find_positions(const struct scene *scene)
{
    if (!scene->previous_positions)
        return (struct technique_texels){ 0 };
    return (struct technique_texels){
        .texels = scene->previous_positions,
        .width = FIRST_SURFACE_WIDTH,
        .height = first_surface_rows(&scene->model),
        .no_mips = true,
    };
}

static const float no_position[4] = { 0 };

static const struct technique_import imports[] = {
    { &first_surface_positions, find_positions, no_position },
    { 0 },
};

static const struct frame_layer layers[] = {
    {
        .name = "albedo",
        .image = &first_surface_albedo,
        .planes = { "albedo.R", "albedo.G", "albedo.B" },
        .help = "linear base colour of the first visible surface",
    },
    {
        .name = "motion",
        .image = &first_surface_motion,
        .planes = { "motion.X", "motion.Y" },
        .shown = FRAME_SHOWN_POSITION,
        .help =
            "motion of the first visible surface since the previous frame, pixels right and down",
    },
    { 0 },
};

const struct technique first_surface = {
    .name = "first_surface",
    .help = "base colour and motion of the first visible surface",
    .layers = layers,
    .uploads = uploads,
    .imports = imports,
    .pass_groups = { { PHASE_SURFACES, .graph = RG_TECHNIQUE("first_surface", passes) } },
};
