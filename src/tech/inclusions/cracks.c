/*
 * cracks.c: cracks inside the ice: highlights, and reflections of air gaps.
 *
 * Seipel and Nivfors 2006, section 3.3: double-sided, bump-mapped sheets at random positions near
 * the object's centre; fragments outside the object are discarded. They show only specular
 * highlights and are transparent elsewhere. The paper's clipping (cracks.clip=convex) is correct
 * for convex objects; in a concave one it keeps fragments between two parts of the object. Clipping
 * to the intervals of each pixel's ray is correct for any closed object. The bump map is procedural
 * noise.
 *
 * cracks.refract=normals is the experiment of the paper's section 5, which overstates the effect,
 * as the paper notes: light leaves a parallel gap in the direction in which it enters.
 * cracks.refract=gap models this: light that a thin air gap does not reflect continues straight;
 * towards the rim the gap gets thinner, shows interference colours and then nothing
 * (shaders/inclusions/cracks_reflectance.h). cracks.debug draws the sheets in opaque red, like the
 * paper's figures 5c and 5d.
 *
 * A refraction model with refraction_model.refracts_cracks intersects gaps along the refracted ray
 * and continues the path there.
 *
 * Error: other models show cracks along the unrefracted ray, and the cracks' light is not refracted
 * at the surface above. Cracks are blended in mesh order, not by depth; a refracted ray hits at
 * most one.
 */
#include "src/tech/inclusions/cracks.h"
#include "shaders/embedded.h"
#include "shaders/specialization_constants.h"
#include "src/tech/frame_resources.h"
#include "src/tech/ice/ice_depth.h"
#include "src/tech/ice/ice_gbuffer.h"
#include "src/tech/ice/ice_interval.h"
#include "src/tech/pass_arena.h"
#include "src/tech/refract/refract.h"

static rg_record_fn record_cracks;

const struct rg_image cracks_color = {
    .name = "cracks.color",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

const struct rg_image cracks_hits = {
    .name = "cracks.hits",
    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
};

static const struct rg_image cracks_depth = {
    .name = "cracks.depth",
    .format = VK_FORMAT_D32_SFLOAT,
};

/* A clipping method: its shaders and the resources that they use. */
struct clipping {
    const struct rg_use *uses, *normal_uses;
    const struct rg_shader *vert, *color, *gap, *normal, *hit;
    bool before_back; /* depth test clips at the back */
};

static const struct rg_use globals_use[] = { FRAME_USE_GLOBALS, { 0 } };

static const struct rg_use front_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(ice_depth_front, CRACKS_FRONT, .sampler = &frame_same_texel),
    { 0 },
};

static const struct rg_use depth_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(ice_depth_front, CRACKS_FRONT, .sampler = &frame_same_texel),
    FRAME_SAMPLE(ice_depth_back, CRACKS_BACK, .sampler = &frame_same_texel),
    { 0 },
};

static const struct rg_use cube_use[] = {
    FRAME_SAMPLE(frame_env_cube, CRACKS_ENV_CUBE, .sampler = &frame_linear),
    { 0 },
};

static const struct clipping convex = {
    .uses = front_uses,
    .normal_uses = depth_uses,
    .vert = &cracks_vert,
    .color = &cracks_convex_color_frag,
    .gap = &cracks_convex_gap_frag,
    .normal = &cracks_convex_normal_frag,
    .hit = &cracks_convex_hit_frag,
    .before_back = true,
};

/* Shaders without clipping, for cracks drawn over the whole image. */
static const struct clipping none = {
    .uses = globals_use,
    .normal_uses = globals_use,
    .vert = &cracks_unclipped_vert,
    .color = &cracks_unclipped_color_frag,
    .gap = &cracks_unclipped_gap_frag,
    .normal = &cracks_unclipped_normal_frag,
};

static const struct clipping interval = {
    .vert = &cracks_vert,
    .color = &cracks_interval_color_frag,
    .gap = &cracks_interval_gap_frag,
    .normal = &cracks_interval_normal_frag,
    .hit = &cracks_interval_hit_frag,
    .before_back = true,
};

static const struct rg_use *use_intervals(struct pass_arena *builder, uint32_t index)
{
    const struct rg_use layers[] = {
        FRAME_SAMPLE(ice_interval_near[index], CRACKS_NEAR, .sampler = &frame_same_texel),
        FRAME_SAMPLE(ice_interval_far[index], CRACKS_FAR, .sampler = &frame_same_texel),
        { 0 },
    };
    return pass_arena_join_uses(builder, (const struct rg_use *const[]){ globals_use, layers }, 2);
}

/* Returns the method that clips cracks at the object's surface. Convex objects need no depth
 * peeling, because a ray is inside them from the nearest to the farthest face. */
static struct clipping find_clipping(const struct technique_config *config,
                                     struct pass_arena *builder)
{
    const struct cracks_params *params = settings_of(config->settings, &cracks_settings);
    struct clipping found = none;
    if (params->clip == CRACKS_CLIP_CONVEX || params->clip == CRACKS_CLIP_INTERVAL)
        found = convex;
    if (params->clip == CRACKS_CLIP_INTERVAL && !config->scene->is_convex) {
        found = interval;
        found.uses = use_intervals(builder, ice_interval_index(config->settings));
        found.normal_uses = found.uses;
    }
    return found;
}

static const struct rg_pass color_pass = {
    .name = "cracks.color",
    .color = RG_TARGETS({ &cracks_color, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER }),
    .vertices = &frame_mesh_layout,
    .push_size = sizeof(struct cracks_shading),
    .record = record_cracks,
};

static const struct rg_pass color_before_back_pass = {
    .name = "cracks.color",
    .color = RG_TARGETS({ &cracks_color, RG_LOAD_CLEAR, .blend = RG_BLEND_OVER }),
    ICE_DEPTH_BEFORE_BACK,
    .vertices = &frame_mesh_layout,
    .push_size = sizeof(struct cracks_shading),
    .record = record_cracks,
};

static const struct rg_pass normal_pass = {
    .name = "cracks.normal",
    .color = RG_TARGETS({ &ice_normal_back, RG_LOAD_KEEP }),
    .depth = { &cracks_depth, RG_LOAD_CLEAR, { .depthStencil = { 1.0f, 0 } } },
    .depth_compare = VK_COMPARE_OP_LESS,
    .vertices = &frame_mesh_layout,
    .push_size = sizeof(struct cracks_shading),
    .record = record_cracks,
};

static const struct rg_pass hit_pass = {
    .name = "cracks.hits",
    .color = RG_TARGETS({ &cracks_hits, RG_LOAD_CLEAR }),
    .depth = { &cracks_depth, RG_LOAD_CLEAR, { .depthStencil = { 1.0f, 0 } } },
    .depth_compare = VK_COMPARE_OP_LESS,
    .vertices = &frame_mesh_layout,
    .push_size = sizeof(struct cracks_shading),
    .record = record_cracks,
};

static const struct rg_pass composite_passes[] = {
    {
        .name = "cracks.composite",
        .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP, .blend = RG_BLEND_OVER }),
        .uses =
            RG_USES(FRAME_SAMPLE(cracks_color, REFRACT_COMPOSITE, .sampler = &frame_same_texel)),
        .vert = &fullscreen_vert,
        .frag = &refract_composite_frag,
        .record = frame_draw_screen,
    },
};

static void record_cracks(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct cracks_params *params = settings_of(frame->settings, &cracks_settings);
    rg_cmd_push(cmd, &params->shading, sizeof(params->shading));
    frame_draw_mesh(cmd, frame, &cracks);
}

static const char *const clip_names[] = { "convex", "interval", "none", NULL };
static const char *const refract_names[] = { "off", "normals", "gap", NULL };

static const struct setting rows[] = {
    {
        SETTING_FIELD("cracks.count", COUNT, struct cracks_params, count),
        .label = "Cracks",
        .initial = 2,
        .max = CRACKS_MAX,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "number of cracks inside the ice",
    },
    {
        SETTING_FIELD("cracks.seed", COUNT, struct cracks_params, seed),
        .label = "Random seed of the cracks",
        .initial = 1,
        .max = 999999,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "random seed of the cracks",
    },
    {
        SETTING_FIELD("cracks.size", FLOAT, struct cracks_params, size),
        .label = "Crack size",
        .initial = 1,
        .min = 0.05,
        .max = 4,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "width of the cracks; at 1 the cracks are about as wide as the ice",
    },
    {
        SETTING_FIELD("cracks.clip", CHOICE, struct cracks_params, clip),
        .label = "Crack clipping",
        .initial = CRACKS_CLIP_INTERVAL,
        .max = CRACKS_CLIP_NONE,
        .choices = clip_names,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "method that clips cracks to the ice; the paper's method, convex, needs a convex "
                "object",
    },
    {
        SETTING_FIELD("cracks.refract", CHOICE, struct cracks_params, refract),
        .label = "Refraction at cracks",
        .initial = CRACKS_REFRACT_OFF,
        .max = CRACKS_REFRACT_GAP,
        .choices = refract_names,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "refraction of the view at cracks: none, by the cracks' normals, or at air gaps",
    },
    {
        SETTING_FIELD("cracks.strength", FLOAT, struct cracks_params, shading.strength),
        .label = "Crack highlight",
        .initial = 1,
        .max = 100,
        .help = "brightness of the lights' highlights on cracks",
    },
    {
        SETTING_FIELD("cracks.shininess", FLOAT, struct cracks_params, shading.shininess),
        .label = "Crack highlight sharpness",
        .initial = 60,
        .min = 1,
        .max = 10000,
        .help = "Blinn-Phong exponent of the highlights on cracks; a larger one makes them smaller",
    },
    {
        SETTING_FIELD("cracks.bump", FLOAT, struct cracks_params, shading.bump),
        .label = "Crack roughness",
        .initial = 0.35,
        .max = 4,
        .help = "roughness of the cracks' surface (0: smooth)",
    },
    {
        SETTING_FIELD("cracks.gap", FLOAT, struct cracks_params, shading.gap),
        .label = "Crack air gap",
        .initial = 2.4,
        .min = 0.01,
        .max = 1000,
        .help =
            "width of the air gap in the middle of cracks, micrometres, with cracks.refract=gap",
    },
    {
        SETTING_FIELD("cracks.debug", SWITCH, struct cracks_params, shading.surface),
        .renamed_from = "cracks.surface",
        .label = "Show crack surfaces",
        .max = 1,
        .switches = SETTING_AFFECTS_PLAN,
        .help = "flat red instead of shading on the visible parts of cracks, for debugging",
    },
};

SETTING_GROUP(cracks, rows, struct cracks_params);

static bool is_on(const struct settings *settings)
{
    const struct cracks_params *params = settings_of(settings, &cracks_settings);
    return params->count > 0;
}

bool cracks_are_in_ice(const struct settings *settings)
{
    const struct cracks_params *params = settings_of(settings, &cracks_settings);
    return params->count && params->clip != CRACKS_CLIP_NONE;
}

bool cracks_are_traced(const struct settings *settings, const struct technique *refraction)
{
    const struct cracks_params *params = settings_of(settings, &cracks_settings);
    return refraction && refraction->refraction.refracts_cracks &&
           refraction->refraction.refracts_cracks(settings) && cracks_are_in_ice(settings) &&
           params->refract == CRACKS_REFRACT_GAP && !params->shading.surface;
}

/* Makes the pass that draws the cracks' colour. Without cracks it only clears the image. */
static struct rg_technique make_color(const struct technique_config *config,
                                      struct pass_arena *builder)
{
    const struct cracks_params *params = settings_of(config->settings, &cracks_settings);
    const struct clipping clipping = params->count ? find_clipping(config, builder) : none;
    const bool are_gaps = params->count && params->refract == CRACKS_REFRACT_GAP;
    const struct rg_use *const uses[] = { clipping.uses, are_gaps ? cube_use : NULL };
    struct rg_pass *pass = pass_arena_copy_passes(
        builder, clipping.before_back ? &color_before_back_pass : &color_pass, 1);
    if (!pass)
        return (struct rg_technique){ 0 };
    pass->uses = pass_arena_join_uses(builder, uses, 2);
    pass->vert = clipping.vert;
    pass->frag = are_gaps ? clipping.gap : clipping.color;
    return (struct rg_technique){ "cracks", pass, 1 };
}

static struct rg_technique make_normals(const struct technique_config *config,
                                        struct pass_arena *builder)
{
    const struct cracks_params *params = settings_of(config->settings, &cracks_settings);
    const bool are_traced = cracks_are_traced(config->settings, config->refraction);
    if (!are_traced && (!params->count || params->refract != CRACKS_REFRACT_NORMALS))
        return (struct rg_technique){ 0 };
    const struct clipping clipping = find_clipping(config, builder);
    struct rg_pass *pass =
        pass_arena_copy_passes(builder, are_traced ? &hit_pass : &normal_pass, 1);
    if (!pass)
        return (struct rg_technique){ 0 };
    pass->uses = clipping.normal_uses;
    pass->vert = &cracks_vert;
    pass->frag = are_traced ? clipping.hit : clipping.normal;
    return (struct rg_technique){ are_traced ? "cracks_hits" : "cracks_normal", pass, 1 };
}

static bool are_unclipped(const struct technique_config *config)
{
    return !cracks_are_in_ice(config->settings);
}

static const struct mesh *find_sheets(const struct scene *scene)
{
    return &scene->inclusions.cracks;
}

static const struct frame_layer layers[] = {
    {
        .name = "cracks",
        .image = &cracks_color,
        .planes = { "cracks.R", "cracks.G", "cracks.B", "cracks.A" },
        .mean = true,
        .help = "radiance of the cracks inside the ice, premultiplied",
    },
    { 0 },
};

static void write_constants(const struct technique_config *config, uint32_t *values)
{
    values[CONSTANT_CRACKS_TRACED] = cracks_are_traced(config->settings, config->refraction);
}

const struct technique cracks = {
    .name = "cracks",
    .help = "cracks in the ice",
    .settings = &cracks_settings,
    .is_on = is_on,
    .is_traced = true,
    .is_ice_only = true,
    .is_hit = true,
    .pass_groups = { { PHASE_NORMALS, .make_passes = make_normals },
                     { PHASE_INCLUSIONS, .make_passes = make_color },
                     { PHASE_FINISH, .graph = RG_TECHNIQUE("cracks_composite", composite_passes),
                       .is_drawn = are_unclipped } },
    .layers = layers,
    .mesh = find_sheets,
    .write_constants = write_constants,
};
