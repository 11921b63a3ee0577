/*
 * ssr.c: screen-space reflections of the refractive objects in glossy surroundings.
 *
 * Screen-space ray marching after Sousa, Kasyan and Schulz 2011, Secrets of CryENGINE 3 Graphics
 * Technology ("real-time local reflections"): reflected rays are marched linearly through the depth
 * buffer, then refined by bisection. Two changes make it cheap and robust: only the objects are
 * intersected, whose colour and depth are copied before the surroundings are drawn over them, so
 * that occluders do not hide reflections; and rays are marched only inside the objects' bounding
 * box, so that a few steps suffice. A hit replaces the environment's contribution to the specular
 * term, which conserves energy in a uniform environment. Rough surfaces sample prefiltered mip
 * levels whose texels match the footprint of the lobe at the hit. At half resolution, rays that hit
 * ice are refracted there by the refraction model.
 *
 * Limits: a reflection without refraction shows the camera's view of the object, with sun glints
 * clamped. Hidden sides close behind an edge repeat its colours; what is farther behind, or off
 * screen, has no reflection. Reflections are drawn only around and below the objects' base. The
 * lobe is isotropic, and ends at the outline of a perfectly sharp one. Opaque surroundings do not
 * reflect each other, and surroundings visible in or through the objects have no reflections of
 * them.
 */
#include "src/tech/surroundings/ssr.h"
#include <cglm/struct.h>
#include "shaders/embedded.h"
#include "shaders/surroundings/ssr.h"
#include "src/scene/gpu_material_table.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/pass_arena.h"
#include "src/tech/refract/refract.h"
#include "src/tech/refract/refract_bounce.h"

static const float edge_fraction = 0.08f; /* fade-out width at image edges */

static rg_record_fn record_copy, record_half, record_find, record_refracted, record_screen;

const struct rg_image ssr_surface = {
    .name = "ssr.surface",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image ssr_specular = {
    .name = "ssr.specular",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

/* Colour of the refractive objects, with mip levels. Pixels far from the objects are undefined. */
static const struct rg_image object_color = {
    .name = "ssr.objects",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .mips = RG_ALL_MIPS,
};

static const struct rg_image object_depth = {
    .name = "ssr.object_depth",
    .format = VK_FORMAT_R32_SFLOAT,
};

/* Half-resolution images of reflected rays that hit an object. They contain the hit point relative
 * to the camera, ray direction, hit mask (a depth buffer) and premultiplied refracted colour. */
static const struct rg_image hit_point = {
    .name = "ssr.hit_point",
    .format = VK_FORMAT_R32G32B32A32_SFLOAT,
    .scale = 0.5f,
};

static const struct rg_image hit_dir = {
    .name = "ssr.hit_dir",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .scale = 0.5f,
};

static const struct rg_image hit_mask = {
    .name = "ssr.hit_mask",
    .format = VK_FORMAT_D32_SFLOAT,
    .scale = 0.5f,
};

static const struct rg_image refracted = {
    .name = "ssr.refracted",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
    .scale = 0.5f,
};

static const struct rg_fallback none_refracted = { { 0 } };

static const struct rg_sampler object_sampler = { .linear = true, .mips = true };

#define DOWNSAMPLE_FROM(...) \
    .uses = RG_USES(FRAME_SAMPLE(object_color, SSR_COLOR, .sampler = &frame_linear, \
                                 .range = { __VA_ARGS__ })), \
    .vert = &fullscreen_vert, .frag = &ssr_downsample_frag

static const struct rg_pass object_passes[] = {
    {
        .name = "ssr.objects",
        .color = RG_TARGETS({ &object_color, RG_LOAD_DISCARD }, { &object_depth, RG_LOAD_CLEAR }),
        .uses = RG_USES(FRAME_READ(frame_color, SSR_COLOR), FRAME_READ(frame_depth, SSR_DEPTH)),
        .vert = &fullscreen_vert,
        .frag = &ssr_copy_frag,
        .record = record_copy,
    },
    {
        .name = "ssr.half",
        .color = RG_TARGETS({ &object_color, RG_LOAD_CLEAR, .mip = 1 }),
        DOWNSAMPLE_FROM(.mip_count = 1),
        .record = record_half,
    },
    {
        .name = "ssr.downsample",
        .repeat = RG_PER_MIP,
        .color = RG_TARGETS({ &object_color, RG_LOAD_DISCARD, .mip = 2 }),
        DOWNSAMPLE_FROM(.mip = 1, .each = true),
        .record = frame_draw_screen,
    },
};

static const struct rg_use refracted_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_READ(ice_normal_shading, REFRACT_SHADING),
    FRAME_SAMPLE(hit_point, SSR_HIT_POINT, .sampler = &frame_same_texel),
    FRAME_SAMPLE(hit_dir, SSR_HIT_DIR, .sampler = &frame_same_texel),
    { 0 },
};

static const struct rg_pass refracted_passes[] = {
    {
        .name = "ssr.trace",
        .color = RG_TARGETS({ &hit_point, RG_LOAD_DISCARD }, { &hit_dir, RG_LOAD_DISCARD }),
        .depth = { &hit_mask, RG_LOAD_CLEAR },
        .depth_compare = VK_COMPARE_OP_ALWAYS,
        .uses = RG_USES(FRAME_USE_GLOBALS, FRAME_READ(frame_depth, SSR_DEPTH),
                        FRAME_READ(object_depth, SSR_OBJECT_DEPTH),
                        FRAME_READ(ssr_surface, SSR_SURFACE)),
        .vert = &fullscreen_ray_vert,
        .frag = &ssr_trace_frag,
        .push_size = sizeof(struct ssr_push),
        .record = record_find,
    },
    {
        .name = "ssr.refracted",
        .color = RG_TARGETS({ &refracted, RG_LOAD_CLEAR }),
        .depth = { &hit_mask, RG_LOAD_KEEP },
        .depth_read_only = true,
        .depth_compare = VK_COMPARE_OP_LESS,
        .push_size = sizeof(struct refract_bounce_params),
        .record = record_refracted,
    },
};

static const struct rg_pass screen_passes[] = {
    {
        .name = "ssr.composite",
        .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP, .blend = RG_BLEND_ADD }),
        .uses = RG_USES(FRAME_USE_GLOBALS,
                        FRAME_SAMPLE(frame_depth, SSR_DEPTH, .sampler = &frame_same_texel),
                        FRAME_SAMPLE(object_color, SSR_OBJECTS, .sampler = &object_sampler),
                        FRAME_SAMPLE(refracted, SSR_REFRACTED, .sampler = &frame_linear,
                                     .fallback = &none_refracted),
                        FRAME_READ(object_depth, SSR_OBJECT_DEPTH),
                        FRAME_SAMPLE(ssr_surface, SSR_SURFACE, .sampler = &frame_same_texel),
                        FRAME_SAMPLE(ssr_specular, SSR_SPECULAR, .sampler = &frame_same_texel)),
        .vert = &fullscreen_ray_vert,
        .frag = &ssr_frag,
        .push_size = sizeof(struct ssr_push),
        .record = record_screen,
    },
};

/* Returns the area of a mip level that covers an area of level 0, plus a margin in texels. */
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

/* Copies the objects' pixels and a margin, which the filter of the next mip level reads. */
static void record_copy(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_scissor(cmd, area_at(frame->object_area, 0, 4, rg_cmd_extent(cmd)));
    rg_cmd_draw(cmd, 3);
}

static void record_half(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_scissor(cmd, area_at(frame->object_area, 1, 1, rg_cmd_extent(cmd)));
    rg_cmd_draw(cmd, 3);
}

/* Returns the longest bounding-box diagonal among the objects. */
static float thickness_of(const struct scene *scene)
{
    float most = 0.0f;
    for (uint32_t i = 0; i < scene->model.object_count; i++)
        most = fmaxf(most, box_diagonal(scene->model.objects[i].box));
    return most;
}

/* Writes an area to the push constants. Reflections fade at its edges, except at image borders. */
static void write_area(struct ssr_push *push, VkRect2D area, VkExtent2D image_size)
{
    const int32_t first[2] = { area.offset.x, area.offset.y };
    const uint32_t size[2] = { area.extent.width, area.extent.height };
    const uint32_t sides[2] = { image_size.width, image_size.height };
    for (int axis = 0; axis < 2; axis++) {
        const uint32_t last = (uint32_t)first[axis] + size[axis];
        push->area_min.raw[axis] = first[axis] > 0 ? (float)first[axis] : -1e6f;
        push->area_max.raw[axis] = last < sides[axis] ? (float)last : 1e6f;
        push->area_edge.raw[axis] = edge_fraction * (float)size[axis];
    }
}

static void push_all(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct ssr_params *params = settings_of(frame->settings, &ssr_settings);
    struct ssr_push push = {
        .box_min = frame->scene->box.min,
        .box_max = frame->scene->box.max,
        .steps = params->steps,
        .thickness = thickness_of(frame->scene),
        .pixel = 2.0f * glms_vec3_norm(frame->view.up) / (float)rg_cmd_extent(cmd).height,
    };
    write_area(&push, frame->ground_area, rg_cmd_extent(cmd));
    rg_cmd_push(cmd, &push, sizeof(push));
}

static void record_find(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push_all(cmd, frame);
    rg_cmd_scissor(cmd, area_at(frame->ground_area, 1, 1, rg_cmd_extent(cmd)));
    rg_cmd_draw(cmd, 3);
}

static void record_refracted(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &refract_bounce_settings),
                sizeof(struct refract_bounce_params));
    rg_cmd_scissor(cmd, area_at(frame->ground_area, 1, 1, rg_cmd_extent(cmd)));
    rg_cmd_draw(cmd, 3);
}

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    push_all(cmd, frame);
    rg_cmd_scissor(cmd, frame->ground_area);
    rg_cmd_draw(cmd, 3);
}

static const struct setting rows[] = {
    {
        SETTING_FIELD("ssr.steps", COUNT, struct ssr_params, steps),
        .renamed_from = "mirror.steps",
        .label = "Reflection steps",
        .initial = 8,
        .max = 64,
        .switches = SETTING_AFFECTS_PLAN,
        .help = "ray march steps of screen-space reflections of objects in glossy surroundings (0: "
                "off); not used by reference, and by trace unless trace.surroundings=cube",
    },
    {
        SETTING_FIELD("ssr.refract", SWITCH, struct ssr_params, refract),
        .renamed_from = "mirror.refract",
        .label = "Refraction in reflections",
        .initial = 1,
        .max = 1,
        .affects = SETTING_AFFECTS_PLAN,
        .help =
            "refract rays that surroundings reflect to the object, instead of reusing the camera's "
            "view of the object (only refraction model bounce, with one object that is not nested)",
    },
};

SETTING_GROUP(ssr, rows, struct ssr_params);

static bool is_on(const struct settings *settings)
{
    const struct ssr_params *params = settings_of(settings, &ssr_settings);
    return params->steps > 0;
}

bool ssr_is_drawn(const struct technique_config *config)
{
    const struct ground_params *ground = settings_of(config->settings, &ground_settings);
    return is_on(config->settings) && ground->shading == GROUND_PIXELS &&
           config->scene->tables.materials &&
           material_table_has_reflective(&config->scene->model) && !config->scene->has_pool &&
           config->purpose == TECHNIQUE_IMAGE && config->refraction &&
           !technique_hits_surroundings(config);
}

/* Returns the shader that refracts reflected rays in the object, or NULL if the rays read the image
 * instead. Several or nested objects need NULL, as they overwrite each other's depth maps. */
static const struct rg_shader *refracted_frag(const struct technique_config *config)
{
    const struct ssr_params *params = settings_of(config->settings, &ssr_settings);
    if (!params->refract || !config->refraction->refraction.shaders || config->object_count > 1 ||
        config->is_nested)
        return NULL;
    return ice_gbuffer_has_materials(config) ? refract_shaders_of(config)->ssr_material_frag
                                             : refract_shaders_of(config)->ssr_frag;
}

static struct rg_technique make_refracted_passes(const struct technique_config *config,
                                                 struct pass_arena *builder)
{
    const struct rg_shader *frag = ssr_is_drawn(config) ? refracted_frag(config) : NULL;
    struct rg_pass *own = frag ? pass_arena_copy_passes(builder, refracted_passes, 2) : NULL;
    if (!own)
        return (struct rg_technique){ 0 };
    const struct refract_shaders *refraction = config->refraction->refraction.shaders;
    const struct rg_use *const uses[] = {
        refracted_uses,
        config->is_wide ? refraction->wide_uses : refraction->uses,
        ice_gbuffer_has_materials(config) ? refract_material_uses : NULL,
        refract_has_medium(config) ? refract_medium_uses : NULL,
    };
    own[1].uses = pass_arena_join_uses(builder, uses, sizeof(uses) / sizeof(uses[0]));
    own[1].vert = refraction->vert;
    own[1].frag = frag;
    return (struct rg_technique){ "ssr", own, 2 };
}

const struct technique ssr = {
    .name = "ssr",
    .help = "screen-space reflections of the objects in glossy surroundings",
    .settings = &ssr_settings,
    .is_on = is_on,
    .is_traced = true,
    .is_hit = true,
    .title = "screen-space reflections",
    .pass_groups = { { PHASE_COMPOSITE, SCENE_OF_OBJECT,
                       .graph = RG_TECHNIQUE("ssr", object_passes), .is_drawn = ssr_is_drawn },
                     { PHASE_FINISH, SCENE_OF_OBJECT, .make_passes = make_refracted_passes },
                     { PHASE_FINISH, SCENE_OF_OBJECT, .graph = RG_TECHNIQUE("ssr", screen_passes),
                       .is_drawn = ssr_is_drawn } },
};
