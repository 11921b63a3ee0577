/*
 * ice_nested.c: depth layers of nested objects and cavities.
 *
 * Depth peeling from both sides (Everitt 2001; Bavoil and Myers 2008, Order Independent
 * Transparency with Dual Depth Peeling): each level keeps the nearest and the farthest of the faces
 * that lie between those of the surrounding level. With convex objects these are front and back
 * faces.
 *
 * Error: objects side by side in a level hide parts of each other.
 */
#include "src/tech/ice/ice_nested.h"
#include <cglm/struct.h>
#include "shaders/embedded.h"
#include "src/tech/frame_media.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/inclusions/medium_density_fields.h"
#include "src/tech/pass_arena.h"

static rg_record_fn record_near, record_far;

const struct rg_image ice_nested_depths = {
    .name = "ice_nested.depths",
    .format = VK_FORMAT_R32_SFLOAT,
    .layers = 2 * ICE_NESTED_LEVELS,
    .array = true,
};

const struct rg_image ice_nested_normals = {
    .name = "ice_nested.normals",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .layers = 2 * ICE_NESTED_LEVELS,
    .array = true,
};

static const struct rg_image depth_test = {
    .name = "ice_nested.depth_test",
    .format = VK_FORMAT_D32_SFLOAT,
};

const struct rg_image ice_nested_wide_depths = {
    .name = "ice_nested.wide_depths",
    .format = VK_FORMAT_R32_SFLOAT,
    .layers = 2 * ICE_NESTED_LEVELS,
    .array = true,
    .scale = ICE_NORMAL_WIDE,
};

const struct rg_image ice_nested_wide_normals = {
    .name = "ice_nested.wide_normals",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .layers = 2 * ICE_NESTED_LEVELS,
    .array = true,
    .scale = ICE_NORMAL_WIDE,
};

static const struct rg_image wide_depth_test = {
    .name = "ice_nested.wide_depth_test",
    .format = VK_FORMAT_D32_SFLOAT,
    .scale = ICE_NORMAL_WIDE,
};

const struct rg_buffer ice_nested_media = {
    .name = "ice_nested.media",
    .size = sizeof(struct ice_nested_media),
    .memory = RG_MEMORY_UPLOAD,
};

#define FACES(title, at, ...) \
    { \
        .name = (title), \
        .color = RG_TARGETS({ &ice_nested_normals, RG_LOAD_CLEAR, .layer = (at) }, \
                            { &ice_nested_depths, RG_LOAD_CLEAR, .layer = (at) }), \
        .vert = &ice_nested_vert, .vertices = &frame_mesh_layout, \
        .push_size = sizeof(struct ice_nested_push), __VA_ARGS__ \
    }
#define NEAR \
    .depth = { &depth_test, RG_LOAD_CLEAR }, .depth_compare = VK_COMPARE_OP_GREATER, \
    .record = record_near
#define FAR \
    .depth = { &depth_test, RG_LOAD_CLEAR, { .depthStencil = { 1.0f, 0 } } }, \
    .depth_compare = VK_COMPARE_OP_LESS, .record = record_far
#define OUTERMOST .frag = &ice_nested_peel_frag, .uses = RG_USES(FRAME_USE_GLOBALS)
#define BEHIND(first_layer) \
    .frag = &ice_nested_inner_frag, \
    .uses = RG_USES(FRAME_USE_GLOBALS, { .image = &ice_nested_depths, \
                                         .access = RG_SAMPLED, \
                                         .binding = ICE_NESTED_BEFORE, \
                                         .sampler = &frame_same_texel, \
                                         .range = { .layer = (first_layer), .layer_count = 2 } })

static const struct rg_pass passes[] = {
    FACES("ice_nested.near", 0, NEAR, OUTERMOST),
    FACES("ice_nested.far", 1, FAR, OUTERMOST),
    FACES("ice_nested.near_inside", 2, NEAR, BEHIND(0)),
    FACES("ice_nested.far_inside", 3, FAR, BEHIND(0)),
    FACES("ice_nested.near_innermost", 4, NEAR, BEHIND(2)),
    FACES("ice_nested.far_innermost", 5, FAR, BEHIND(2)),
};

/* Returns 1 + the index of the object with nesting priority `rank`, or 0 if there is none. */
static uint32_t medium_of(const struct model *model, uint32_t rank)
{
    for (uint32_t i = 0; i < model->object_count; i++) {
        if (rank && model->objects[i].rank == rank)
            return i + 1;
    }
    return 0;
}

/* Draws the object of the pass and all objects nested in it. */
static void record(struct rg_cmd *cmd, const struct rg_frame *frame, bool is_far)
{
    const struct model *model = &frame->scene->model;
    const struct object *root = frame_object_of(cmd, frame);
    for (uint32_t i = 0; i < model->object_count; i++) {
        const struct object *object = &model->objects[i];
        if (object_outermost(model->objects, i) != (uint32_t)(root - model->objects))
            continue;
        const struct ice_nested_push push = { i + 1, medium_of(model, object->container_rank),
                                              is_far };
        rg_cmd_push(cmd, &push, sizeof(push));
        rg_cmd_draw_mesh_part(cmd, &frame->object, object->first_index, object->index_count);
    }
}

static void record_near(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    record(cmd, frame, false);
}

static void record_far(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    record(cmd, frame, true);
}

/* Makes a pass render to the images that cover a larger area than the view. */
static void widen(struct pass_arena *builder, struct rg_pass *pass)
{
    struct rg_target *color = pass_arena_copy_targets(builder, pass->color, pass->color_count);
    struct rg_use *uses = pass_arena_copy_uses(builder, pass->uses);
    if (!color || !uses)
        return;
    color[0].image = &ice_nested_wide_normals;
    color[1].image = &ice_nested_wide_depths;
    for (struct rg_use *use = uses; use->access; use++)
        use->image = use->image ? &ice_nested_wide_depths : NULL;
    pass->color = color;
    pass->uses = uses;
    pass->depth.image = &wide_depth_test;
    pass->vert = &ice_nested_wide_vert;
}

static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    const size_t count = sizeof(passes) / sizeof(passes[0]);
    if (!config->is_nested)
        return (struct rg_technique){ 0 };
    struct rg_pass *copies = pass_arena_copy_passes(builder, passes, count);
    for (size_t i = 0; copies && config->is_wide && i < count; i++)
        widen(builder, &copies[i]);
    return (struct rg_technique){ "ice_nested", copies, copies ? count : 0 };
}

bool ice_nested_is_in(const struct scene *scene)
{
    const struct model *model = &scene->model;
    bool found = false;
    for (uint32_t i = 0; i < model->object_count; i++)
        found = found || model->objects[i].enclosing_object;
    return found;
}

bool ice_nested_fits(const struct scene *scene)
{
    return frame_media_count(scene) <= ICE_NESTED_MEDIA_MAX;
}

uint32_t ice_nested_outermost_count(const struct scene *scene)
{
    const struct model *model = &scene->model;
    uint32_t count = 0;
    for (uint32_t i = 0; i < model->object_count; i++)
        count += !model->objects[i].enclosing_object;
    return count;
}

static void write_media(void *memory, const struct frame_view *view, const struct globals *globals)
{
    struct ice_nested_media *media = memory;
    const uint32_t count = frame_media_count(view->scene);
    (void)globals;
    for (uint32_t i = 0; i < count; i++) {
        const struct frame_medium medium = frame_medium_at(view->scene, view->settings, i);
        const uint32_t at = i + 1 == count ? 0 : i + 1;
        media->ior[at] = (vec4s){ { medium.ior[0], medium.ior[1], medium.ior[2], 0.0f } };
        media->absorb[at] = glms_vec4(medium.absorption, 0.0f);
        media->scattering_media[at] = medium_field_of(view->scene, view->settings, i);
    }
}

static const struct technique_upload uploads[] = {
    { &ice_nested_media, write_media },
    { 0 },
};

const struct technique ice_nested = {
    .name = "ice_nested",
    .help = "depth layers of nested objects and cavities",
    .pass_groups = { { PHASE_NORMALS, .make_passes = make_passes } },
    .uploads = uploads,
};
