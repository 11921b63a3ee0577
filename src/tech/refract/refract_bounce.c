/*
 * refract_bounce.c: refraction model with total internal reflections, ray marched in image space.
 *
 * The ray is marched as in refract_search.c, but among front and back faces, and continued where it
 * is reflected, totally or in part. After refract_bounce.exits faces through which light leaves, or
 * after the last bounce, the remaining light is given the mean radiance of the surroundings.
 *
 * Error: as small as that of refract_search.c; with total internal reflections one or a few degrees
 * on average on convex objects, because small errors grow from bounce to bounce. Of a slightly
 * concave object only the nearest faces are known, and none beyond the margin of
 * refract_bounce.margin outside the image. Other objects have three levels of faces (ice_nested.h);
 * objects side by side in a level hide parts of each other.
 */
#include "src/tech/refract/refract_bounce.h"
#include <math.h>
#include "shaders/embedded.h"
#include "shaders/inclusions/bubbles.h"
#include "shaders/refract/refract_bounce.h"
#include "shaders/specialization_constants.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/ice/ice_nested.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/refract/refract.h"

static rg_record_fn record_screen;

const struct rg_buffer bubbles_bvh = {
    .name = "bubbles.bvh",
    .size = (size_t)BUBBLES_NODES_MAX * sizeof(struct bubbles_node),
    .format = VK_FORMAT_R32G32B32A32_UINT, /* llvmpipe reads texels faster than storage buffers */
    .memory = RG_MEMORY_UPLOAD,
};

static const struct rg_fallback no_cracks = { { 0 } };

static const struct rg_use uses[] = {
    REFRACT_USE_FULLSCREEN_CUBE,
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(ice_normal_front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_normal_front_depth, REFRACT_DEPTH_FRONT_MAP),
    FRAME_SAMPLE(cracks_hits, REFRACT_CRACKS, .fallback = &no_cracks),
    { .buffer = &bubbles_bvh, .access = RG_SAMPLED, .binding = REFRACT_BUBBLES },
    { 0 },
};

static const struct rg_use wide_uses[] = {
    REFRACT_USE_FULLSCREEN_CUBE,
    FRAME_SAMPLE(ice_normal_wide_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_wide_back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(ice_normal_wide_front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_normal_wide_front_depth, REFRACT_DEPTH_FRONT_MAP),
    FRAME_SAMPLE(cracks_hits, REFRACT_CRACKS, .fallback = &no_cracks),
    { .buffer = &bubbles_bvh, .access = RG_SAMPLED, .binding = REFRACT_BUBBLES },
    { 0 },
};

static const struct refract_shaders medium_shaders = {
    .frag = &refract_bounce_medium_frag,
    .layers_frag = &refract_bounce_medium_aov_frag,
    .material_frag = &refract_bounce_material_medium_frag,
    .material_layers_frag = &refract_bounce_material_medium_aov_frag,
    .nested_frag = &refract_bounce_nested_medium_frag,
    .nested_layers_frag = &refract_bounce_nested_medium_aov_frag,
    .ssr_frag = &ssr_shade_refractive_hit_medium_frag,
    .ssr_material_frag = &ssr_shade_refractive_hit_material_medium_frag,
};

static const struct rg_use nested_uses[] = {
    REFRACT_USE_FULLSCREEN_CUBE,
    FRAME_READ(ice_nested_depths, ICE_NESTED_DEPTHS),
    FRAME_SAMPLE(ice_nested_normals, ICE_NESTED_NORMALS, .sampler = &frame_linear),
    { .buffer = &ice_nested_media, .access = RG_UNIFORM, .binding = ICE_NESTED_MEDIA },
    { .buffer = &bubbles_bvh, .access = RG_SAMPLED, .binding = REFRACT_BUBBLES },
    { 0 },
};

static const struct rg_use nested_wide_uses[] = {
    REFRACT_USE_FULLSCREEN_CUBE,
    FRAME_READ(ice_nested_wide_depths, ICE_NESTED_DEPTHS),
    FRAME_SAMPLE(ice_nested_wide_normals, ICE_NESTED_NORMALS, .sampler = &frame_linear),
    { .buffer = &ice_nested_media, .access = RG_UNIFORM, .binding = ICE_NESTED_MEDIA },
    { .buffer = &bubbles_bvh, .access = RG_SAMPLED, .binding = REFRACT_BUBBLES },
    { 0 },
};

static const struct refract_shaders refraction = {
    .frag = &refract_bounce_frag,
    .layers_frag = &refract_bounce_aov_frag,
    .material_frag = &refract_bounce_material_frag,
    .material_layers_frag = &refract_bounce_material_aov_frag,
    .medium_shaders = &medium_shaders,
    .nested_frag = &refract_bounce_nested_frag,
    .nested_layers_frag = &refract_bounce_nested_aov_frag,
    .ssr_frag = &ssr_shade_refractive_hit_frag,
    .ssr_material_frag = &ssr_shade_refractive_hit_material_frag,
    .vert = &refract_fullscreen_mean_vert,
    .uses = uses,
    .wide_uses = wide_uses,
    .nested_uses = nested_uses,
    .nested_wide_uses = nested_wide_uses,
    .push_size = sizeof(struct refract_bounce_params),
    .record = record_screen,
};

static void record_screen(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    rg_cmd_push(cmd, settings_of(frame->settings, &refract_bounce_settings),
                sizeof(struct refract_bounce_params));
    rg_cmd_scissor(cmd, frame_object_area(cmd, frame));
    rg_cmd_draw(cmd, 3);
}

static const char *const nested_choices[] = {
    [REFRACT_BOUNCE_NESTED_OFF] = "off",
    [REFRACT_BOUNCE_NESTED_ON] = "on",
    [REFRACT_BOUNCE_NESTED_ALL] = "all",
    NULL,
};

static const char *const bent_choices[] = {
    [REFRACT_BOUNCE_INCLUSIONS_OFF] = "off",
    [REFRACT_BOUNCE_INCLUSIONS_CRACKS] = "cracks",
    [REFRACT_BOUNCE_INCLUSIONS_ALL] = "all",
    NULL,
};

static const struct setting rows[] = {
    {
        SETTING_FIELD("refract_bounce.steps", COUNT, struct refract_bounce_params, march.steps),
        .label = "Ray steps (bounce)",
        .initial = 8,
        .min = 1,
        .max = 256,
        .help = "maximum number of steps along a ray inside the object",
    },
    {
        SETTING_FIELD("refract_bounce.bisections", COUNT, struct refract_bounce_params,
                      march.halvings),
        .renamed_from = "refract_bounce.halvings",
        .label = "Bisections (bounce)",
        .initial = 12,
        .max = 32,
        .help = "maximum number of bisections where a ray leaves the object; flat faces need fewer",
    },
    {
        SETTING_FIELD("refract_bounce.reflections", COUNT, struct refract_bounce_params,
                      march.bounces),
        .renamed_from = "refract_bounce.count",
        .label = "Internal reflections",
        .initial = 8,
        .max = 16,
        .help = "maximum number of reflections per ray",
    },
    {
        SETTING_FIELD("refract_bounce.exits", COUNT, struct refract_bounce_params, exits),
        .label = "Exit faces per ray",
        .initial = 2,
        .min = 1,
        .max = 16,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "maximum number of faces at which the light of one ray leaves the object",
    },
    {
        SETTING_FIELD("refract_bounce.min_throughput", FLOAT, struct refract_bounce_params,
                      min_throughput),
        .renamed_from = "refract_bounce.least",
        .label = "Minimum exit throughput",
        .max = 1,
        .help = "path throughput below which an internally reflected ray is not followed",
    },
    {
        SETTING_FIELD("refract_bounce.min_branch", FLOAT, struct refract_bounce_params, branch),
        .renamed_from = "refract_bounce.branch",
        .label = "Minimum crack branch throughput",
        .initial = 0.1,
        .max = 1,
        .help = "minimum throughput of the weaker path for following both paths where a crack "
                "splits a path (once per pixel)",
    },
    {
        SETTING_FIELD("refract_bounce.margin", SWITCH, struct refract_bounce_params, margin),
        .label = "Refraction beyond image edges",
        .initial = 1,
        .max = 1,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "refraction also at faces up to a quarter of the image size outside the image, in "
                "scenes with one object",
    },
    {
        SETTING_FIELD("refract_bounce.nested", CHOICE, struct refract_bounce_params, nested),
        .label = "Refraction at hidden faces",
        .initial = REFRACT_BOUNCE_NESTED_ON,
        .max = REFRACT_BOUNCE_NESTED_ALL,
        .choices = nested_choices,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "refraction also at hidden faces of nested, hollow and folded objects, such as a "
                "teapot (all: of every concave object)",
    },
    {
        SETTING_FIELD("refract_bounce.inclusions", CHOICE, struct refract_bounce_params,
                      inclusions),
        .renamed_from = "refract_bounce.bent",
        .label = "Inclusions along refracted rays",
        .initial = REFRACT_BOUNCE_INCLUSIONS_ALL,
        .max = REFRACT_BOUNCE_INCLUSIONS_ALL,
        .choices = bent_choices,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "inclusions that rays hit inside the object: off (none), cracks (air gaps, which "
                "reflect rays), or all (also bubbles, and cracks in the path of reflected rays)",
    },
};

SETTING_GROUP(refract_bounce, rows, struct refract_bounce_params);

/* Minimum mesh_depth_complexity() at which all faces of an object are rendered. Below this,
 * rendering only the nearest faces causes small errors. */
static const float depth_complexity_min = 0.05f;

bool refract_bounce_is_nested(const struct settings *settings, const struct scene *scene)
{
    const struct refract_bounce_params *params = settings_of(settings, &refract_bounce_settings);
    const struct cracks_params *cracks_of = settings_of(settings, &cracks_settings);
    const bool has_more =
        params->nested == REFRACT_BOUNCE_NESTED_ALL
            ? !scene->is_convex
            : scene->depth_complexity > depth_complexity_min || ice_nested_is_in(scene);
    return params->nested != REFRACT_BOUNCE_NESTED_OFF && has_more && ice_nested_fits(scene) &&
           !scene_has_textured_objects(scene) && cracks_of->refract == CRACKS_REFRACT_OFF;
}

/* Implements refraction_model.choose. Textures and refractive cracks disable config->is_wide. */
static void choose(struct technique_config *config)
{
    const struct refract_bounce_params *params =
        settings_of(config->settings, &refract_bounce_settings);
    const struct cracks_params *cracks_of = settings_of(config->settings, &cracks_settings);
    config->is_nested =
        config->object_count > 0 && refract_bounce_is_nested(config->settings, config->scene);
    if (config->is_nested)
        config->object_count = ice_nested_outermost_count(config->scene);
    config->is_wide = params->margin && config->may_exceed_image && config->object_count == 1 &&
                      !ice_gbuffer_has_materials(config) &&
                      cracks_of->refract == CRACKS_REFRACT_OFF;
}

static bool refracts_cracks(const struct settings *settings)
{
    const struct refract_bounce_params *params = settings_of(settings, &refract_bounce_settings);
    return params->inclusions != REFRACT_BOUNCE_INCLUSIONS_OFF;
}

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    const struct refract_bounce_params *params =
        settings_of(config->settings, &refract_bounce_settings);
    values[CONSTANT_REFRACT_EXITS] = params->exits;
}

/* Returns the ratio of a view's width or height to that of the enlarged G-buffers. */
static float wide_ratio(uint32_t view)
{
    return (float)view / ceilf((float)view * ICE_NORMAL_WIDE);
}

static void write_globals(const struct frame_view *view, struct globals *g)
{
    g->wide_scale = (vec2s){ { wide_ratio(view->width), wide_ratio(view->height) } };
}

const struct technique refract_bounce = {
    .name = "refract_bounce",
    .help = "refraction with total internal reflection, ray marched between front and back faces",
    .settings = &refract_bounce_settings,
    .pass_groups = REFRACT_PACKED_PASS_GROUPS,
    .write_constants = write_constants,
    .write_globals = write_globals,
    .refraction = { .name = "bounce",
                    .shaders = &refraction,
                    .shades_fullscreen = true,
                    .packs_layers = true,
                    .refracts_cracks = refracts_cracks,
                    .choose = choose },
};
