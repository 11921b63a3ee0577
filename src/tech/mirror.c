/*
 * mirror.c: the objects' mirror image in the surroundings, in screen space.
 *
 * Sousa, Kasyan and Schulz 2011, Secrets of CryENGINE 3 Graphics Technology, "real-time local
 * reflections": the ray that a surface mirrors is followed through the depths of the picture. Here
 * only the objects are met. Their colours and depths are kept before the surroundings are drawn
 * over them, so what hides an object does not hide its image; and rays are followed only in the box
 * around them. What is met replaces the light of the environment in the surface's glossy share, so
 * nothing is brighter in an even environment. Rough surfaces look up smaller images of the objects,
 * as wide as their reflections at the distance of what they mirror. For a quarter of the pixels,
 * rays that meet ice are refracted there, and followed as the rung follows those of the eye.
 *
 * Limits: where a ray is not refracted, the image shows what the eye sees, not the surface; the
 * sun's glints are cut off. Sides that the eye does not see are mirrored as if they had the colours
 * of the edges before them; what is outside of the picture is not. The image is drawn around the
 * objects' foot and below it. A rough reflection is as wide as high, and ends at the outline of
 * what a mirror would show. Opaque surroundings do not mirror each other, nor do the surroundings
 * that are seen through and in the objects mirror these.
 */
#include "src/tech/mirror.h"
#include <cglm/struct.h>
#include "shaders/embedded.h"
#include "shaders/mirror.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame.h"
#include "src/tech/ice_normal.h"
#include "src/tech/refract.h"
#include "src/tech/refract_bounce.h"
#include "src/tech/row_builder.h"

static const float edge_share = 0.08f; /* of the area that is drawn */

static rg_record_fn record_seen, record_half, record_find, record_refracted, record_screen;

const struct rg_image mirror_surface = {
    .name = "mirror.surface",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image mirror_glossy = {
    .name = "mirror.glossy",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

/* The first level is undefined beyond a margin around the objects. */
static const struct rg_image seen = {
    .name = "mirror.seen",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .mips = RG_ALL_MIPS,
};

static const struct rg_image front = {
    .name = "mirror.front",
    .format = VK_FORMAT_R32_SFLOAT,
};

/* Of what each fourth pixel mirrors of the objects: where its ray meets them, from the eye, and in
 * which direction; and what the ray sees there, premultiplied, undefined beside the found ones. */
static const struct rg_image point = {
    .name = "mirror.point",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
    .scale = 0.5f,
};

static const struct rg_image dir = {
    .name = "mirror.dir",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .scale = 0.5f,
};

static const struct rg_image is_found = {
    .name = "mirror.is_found",
    .format = VK_FORMAT_D32_SFLOAT,
    .scale = 0.5f,
};

static const struct rg_image refracted = {
    .name = "mirror.refracted",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .scale = 0.5f,
};

static const struct rg_fallback none_refracted = { { 0 } };

static const struct rg_sampler seen_sampler = { .linear = true, .mips = true };

#define SMALLER_FROM(...) \
    .uses = RG_USES( \
        FRAME_SAMPLE(seen, MIRROR_COLOR, .sampler = &frame_linear, .range = { __VA_ARGS__ })), \
    .vert = &screen_vert, .frag = &mirror_smaller_frag

static const struct rg_pass object_passes[] = {
    {
        .name = "mirror.seen",
        .color = RG_TARGETS({ &seen, RG_LOAD_DISCARD }, { &front, RG_LOAD_CLEAR }),
        .uses =
            RG_USES(FRAME_READ(frame_color, MIRROR_COLOR), FRAME_READ(frame_depth, MIRROR_DEPTH)),
        .vert = &screen_vert,
        .frag = &mirror_seen_frag,
        .record = record_seen,
    },
    {
        .name = "mirror.half",
        .color = RG_TARGETS({ &seen, RG_LOAD_CLEAR, .mip = 1 }),
        SMALLER_FROM(.mip_count = 1),
        .record = record_half,
    },
    {
        .name = "mirror.smaller",
        .repeat = RG_PER_MIP,
        .color = RG_TARGETS({ &seen, RG_LOAD_DISCARD, .mip = 2 }),
        SMALLER_FROM(.mip = 1, .each = true),
        .record = frame_draw_screen,
    },
};

static const struct rg_use refracted_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_READ(ice_normal_shading, REFRACT_SHADING),
    FRAME_SAMPLE(point, MIRROR_POINT, .same_texel = true),
    FRAME_SAMPLE(dir, MIRROR_DIR, .same_texel = true),
    { 0 },
};

static const struct rg_pass refracted_passes[] = {
    {
        .name = "mirror.find",
        .color = RG_TARGETS({ &point, RG_LOAD_DISCARD }, { &dir, RG_LOAD_DISCARD }),
        .depth = { &is_found, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_ALWAYS,
        .uses =
            RG_USES(FRAME_USE_GLOBALS, FRAME_READ(frame_depth, MIRROR_DEPTH),
                    FRAME_READ(front, MIRROR_FRONT), FRAME_READ(mirror_surface, MIRROR_SURFACE)),
        .vert = &mirror_vert,
        .frag = &mirror_find_frag,
        .push_size = sizeof(struct mirror_push),
        .record = record_find,
    },
    {
        .name = "mirror.refracted",
        .color = RG_TARGETS({ &refracted, RG_LOAD_CLEAR }),
        .depth = { &is_found, RG_LOAD_KEEP },
        .depth_read_only = true,
        .depth_compare = VK_COMPARE_OP_LESS,
        .push_size = sizeof(struct refract_bounce_params),
        .record = record_refracted,
    },
};

static const struct rg_pass screen_passes[] = {
    {
        .name = "mirror.screen",
        .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }),
        .uses =
            RG_USES(FRAME_USE_GLOBALS, FRAME_SAMPLE(frame_depth, MIRROR_DEPTH, .same_texel = true),
                    FRAME_SAMPLE(seen, MIRROR_SEEN, .sampler = &seen_sampler),
                    FRAME_SAMPLE(refracted, MIRROR_REFRACTED, .sampler = &frame_linear,
                                 .fallback = &none_refracted),
                    FRAME_READ(front, MIRROR_FRONT),
                    FRAME_SAMPLE(mirror_surface, MIRROR_SURFACE, .same_texel = true),
                    FRAME_SAMPLE(mirror_glossy, MIRROR_GLOSSY, .same_texel = true)),
        .vert = &mirror_vert,
        .frag = &mirror_frag,
        .push_size = sizeof(struct mirror_push),
        .record = record_screen,
    },
};

/* Returns the texels of a mip level that show an area of the first one, with a margin of texels. */
static VkRect2D area_at(VkRect2D area, uint32_t mip, int32_t margin, VkExtent2D size)
{
    const int32_t x = area.offset.x >> mip, y = area.offset.y >> mip;
    const int32_t first_x = x > margin ? x - margin : 0, first_y = y > margin ? y - margin : 0;
    const int32_t last_x = ((area.offset.x + (int32_t)area.extent.width) >> mip) + margin;
    const int32_t last_y = ((area.offset.y + (int32_t)area.extent.height) >> mip) + margin;
    const int32_t width = (int32_t)size.width, height = (int32_t)size.height;
    return (VkRect2D){ { first_x, first_y },
                       { (uint32_t)((last_x < width ? last_x : width) - first_x),
                         (uint32_t)((last_y < height ? last_y : height) - first_y) } };
}

/* The margins: smaller levels read no more of the larger one than that has. */
static void record_seen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_scissor(cmd, area_at(frame->object_area, 0, 4, rg_cmd_extent(cmd)));
    rg_cmd_draw(cmd, 3);
}

static void record_half(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_scissor(cmd, area_at(frame->object_area, 1, 1, rg_cmd_extent(cmd)));
    rg_cmd_draw(cmd, 3);
}

/* The depth of the thickest object, along any axis. */
static float thickness_of(const struct scene *scene)
{
    float most = 0.0f;
    for (uint32_t i = 0; i < scene->model.object_count; i++)
        most = fmaxf(most, box_diagonal(scene->model.objects[i].box));
    return most;
}

/* Puts an area into the push constants. Edges that are the picture's are far away. */
static void put_area(struct mirror_push *push, VkRect2D area, VkExtent2D picture)
{
    const int32_t first[2] = { area.offset.x, area.offset.y };
    const uint32_t size[2] = { area.extent.width, area.extent.height };
    const uint32_t sides[2] = { picture.width, picture.height };
    for (int axis = 0; axis < 2; axis++) {
        const uint32_t last = (uint32_t)first[axis] + size[axis];
        push->area_min.raw[axis] = first[axis] > 0 ? (float)first[axis] : -1e6f;
        push->area_max.raw[axis] = last < sides[axis] ? (float)last : 1e6f;
        push->area_edge.raw[axis] = edge_share * (float)size[axis];
    }
}

static void push_all(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct mirror_params *params = settings_of(frame->settings, &mirror_settings);
    struct mirror_push push = {
        .box_min = frame->scene->box.min,
        .box_max = frame->scene->box.max,
        .steps = params->steps,
        .thickness = thickness_of(frame->scene),
        .pixel = 2.0f * glms_vec3_norm(frame->view.up) / (float)rg_cmd_extent(cmd).height,
    };
    put_area(&push, frame->foot_area, rg_cmd_extent(cmd));
    rg_cmd_push(cmd, &push, sizeof(push));
}

static void record_find(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push_all(cmd, frame);
    rg_cmd_scissor(cmd, area_at(frame->foot_area, 1, 1, rg_cmd_extent(cmd)));
    rg_cmd_draw(cmd, 3);
}

static void record_refracted(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &refract_bounce_settings),
                sizeof(struct refract_bounce_params));
    rg_cmd_scissor(cmd, area_at(frame->foot_area, 1, 1, rg_cmd_extent(cmd)));
    rg_cmd_draw(cmd, 3);
}

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push_all(cmd, frame);
    rg_cmd_scissor(cmd, frame->foot_area);
    rg_cmd_draw(cmd, 3);
}

static const struct setting rows[] = {
    {
        .name = "mirror.steps",
        .type = SETTING_COUNT,
        .offset = offsetof(struct mirror_params, steps),
        .initial = 8,
        .max = 64,
        .switches = SETTING_AFFECTS_PLAN,
        .help = "steps of the search for objects that glossy surroundings mirror, in screen space "
                "(0: they mirror none; trace and reference: ground.light)",
    },
    {
        .name = "mirror.refract",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct mirror_params, refract),
        .initial = 1,
        .max = 1,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "mirrored rays refracted by the object that they meet, which otherwise is mirrored "
                "as the eye sees it (rung bounce, scenes with one object, not nested)",
    },
};

const struct setting_group mirror_settings = SETTING_GROUP("mirror", rows, struct mirror_params);

static bool is_on(const struct settings *settings)
{
    const struct mirror_params *params = settings_of(settings, &mirror_settings);
    return params->steps > 0;
}

bool mirror_is_drawn(const struct technique_choice *choice)
{
    const struct ground_params *ground = settings_of(choice->settings, &ground_settings);
    return is_on(choice->settings) && ground->shading == GROUND_PIXELS && choice->has_mirrors &&
           !choice->has_pool && choice->purpose == TECHNIQUE_PICTURE && choice->rung &&
           !choice->rung->rung.meets_tree;
}

static struct rg_technique make_object_rows(const struct technique_choice *choice,
                                            struct row_builder *builder)
{
    (void)builder;
    if (!mirror_is_drawn(choice))
        return (struct rg_technique){ 0 };
    return (struct rg_technique)RG_TECHNIQUE("mirror", object_passes);
}

/* Returns the shader of what mirrored rays see in the object, or NULL: they see what the eye does.
 * Of several objects, and of some in others, the maps of faces are gone when this is drawn. */
static const struct rg_shader *refracted_frag(const struct technique_choice *choice)
{
    const struct mirror_params *params = settings_of(choice->settings, &mirror_settings);
    const struct refract_rung *rung = choice->rung->rung.rows;
    if (!params->refract || !rung || choice->object_count > 1 || choice->is_nested)
        return NULL;
    if (choice->is_cloudy)
        return choice->is_dressed ? rung->cloudy->mirror_dress_frag : rung->cloudy->mirror_frag;
    return choice->is_dressed ? rung->mirror_dress_frag : rung->mirror_frag;
}

static struct rg_technique make_refracted_rows(const struct technique_choice *choice,
                                               struct row_builder *builder)
{
    const struct rg_shader *frag = mirror_is_drawn(choice) ? refracted_frag(choice) : NULL;
    struct rg_pass *own = frag ? row_builder_rows(builder, refracted_passes, 2) : NULL;
    if (!own)
        return (struct rg_technique){ 0 };
    const struct refract_rung *rung = choice->rung->rung.rows;
    const struct rg_use *const uses[] = {
        refracted_uses,
        choice->is_wide ? rung->wide_uses : rung->uses,
        choice->is_dressed ? refract_dress_uses : NULL,
        choice->is_cloudy ? refract_cloud_uses : NULL,
    };
    own[1].uses = row_builder_uses(builder, uses, sizeof(uses) / sizeof(uses[0]));
    own[1].vert = rung->vert;
    own[1].frag = frag;
    return (struct rg_technique){ "mirror", own, 2 };
}

static struct rg_technique make_screen_rows(const struct technique_choice *choice,
                                            struct row_builder *builder)
{
    (void)builder;
    if (!mirror_is_drawn(choice))
        return (struct rg_technique){ 0 };
    return (struct rg_technique)RG_TECHNIQUE("mirror", screen_passes);
}

const struct technique mirror = {
    .name = "mirror",
    .help = "mirror image of the objects in glossy surroundings",
    .settings = { &mirror_settings },
    .is_on = is_on,
    .is_traced = true,
    .is_met = true,
    .title = "mirror image of the objects",
    .parts = { { PHASE_COMPOSITE, SCENE_OF_OBJECT, .rows = make_object_rows },
               { PHASE_FINISH, SCENE_OF_OBJECT, .rows = make_refracted_rows },
               { PHASE_FINISH, SCENE_OF_OBJECT, .rows = make_screen_rows } },
};
