/*
 * ice_interval.c: intervals of primary rays inside concave ice, by depth peeling.
 *
 * Seipel and Nivfors 2006 use the nearest front and the farthest back face as the ends of a single
 * interval, which is right for convex objects only. Depth peeling (Everitt 2001) finds all faces in
 * order: each pass draws the object again and keeps the nearest faces behind the previous layer.
 * Depth is fitted to the object, as in ice_depth.
 *
 * The object must be closed. Points behind the last layer count as outside.
 */
#include "src/tech/ice/ice_interval.h"
#include "shaders/embedded.h"
#include "src/tech/frame_resources.h"
#include "src/tech/pass_arena.h"

const struct rg_image ice_interval_count = {
    .name = "ice_interval.count",
    .format = VK_FORMAT_R32_SFLOAT,
};

#define LAYERS(title, k) \
    { \
        .name = (title), .format = VK_FORMAT_D32_SFLOAT, .layers = (k), .array = true \
    }

const struct rg_image ice_interval_near[ICE_INTERVAL_MAX] = {
    LAYERS("ice_interval.near", 1), LAYERS("ice_interval.near", 2), LAYERS("ice_interval.near", 3),
    LAYERS("ice_interval.near", 4), LAYERS("ice_interval.near", 5), LAYERS("ice_interval.near", 6),
    LAYERS("ice_interval.near", 7), LAYERS("ice_interval.near", 8),
};

const struct rg_image ice_interval_far[ICE_INTERVAL_MAX] = {
    LAYERS("ice_interval.far", 1), LAYERS("ice_interval.far", 2), LAYERS("ice_interval.far", 3),
    LAYERS("ice_interval.far", 4), LAYERS("ice_interval.far", 5), LAYERS("ice_interval.far", 6),
    LAYERS("ice_interval.far", 7), LAYERS("ice_interval.far", 8),
};

/* Pass for depth peeling, which draws the nearest faces behind those of the previous layer. */
static const struct rg_pass peel = {
    .depth = { .load = RG_LOAD_CLEAR, .clear = { .depthStencil = { 1.0f, 0 } } },
    .depth_compare = VK_COMPARE_OP_LESS,
    .vert = &ice_depth_vert,
    .vertices = &frame_mesh_layout,
    .record = frame_draw_object,
};

static const struct rg_pass count = {
    .name = "ice_interval.count",
    .color = RG_TARGETS({ &ice_interval_count, RG_LOAD_CLEAR }),
    .vert = &fullscreen_vert,
    .frag = &ice_interval_count_frag,
    .record = frame_draw_screen,
};

static const struct rg_use globals_use[] = { FRAME_USE_GLOBALS, { 0 } };

/* Returns the resource uses of a pass that reads the globals and some layers of an image. */
static const struct rg_use *use_before(struct pass_arena *builder, const struct rg_image *layers,
                                       struct rg_range range)
{
    const struct rg_use before[] = {
        { .image = layers,
          .access = RG_SAMPLED,
          .binding = ICE_INTERVAL_BEFORE,
          .sampler = &frame_same_texel,
          .range = range },
        { 0 },
    };
    return pass_arena_join_uses(builder, (const struct rg_use *const[]){ globals_use, before }, 2);
}

/* Writes passes for the first layer and, if there are several, for the layers behind it. */
static struct rg_pass *peel_all(struct rg_pass *pass, struct pass_arena *builder,
                                const struct rg_image *layers, const char *first, const char *next)
{
    *pass = peel;
    pass->name = first;
    pass->depth.image = layers;
    pass++;
    if (layers->layers == 1)
        return pass;
    *pass = peel;
    pass->name = next;
    pass->repeat = RG_PER_LAYER;
    pass->depth.image = layers;
    pass->depth.layer = 1;
    pass->uses = use_before(builder, layers, (struct rg_range){ .each = true });
    pass->frag = &ice_interval_next_frag;
    return pass + 1;
}

static struct rg_technique make_passes(const struct technique_config *config,
                                       struct pass_arena *builder)
{
    const uint32_t index = ice_interval_index(config->settings);
    const struct rg_image *near = &ice_interval_near[index];
    const struct rg_image *far = &ice_interval_far[index];
    const struct rg_use count_uses[] = {
        { .image = near,
          .access = RG_SAMPLED,
          .binding = ICE_INTERVAL_NEAR,
          .sampler = &frame_same_texel },
        { .image = far,
          .access = RG_SAMPLED,
          .binding = ICE_INTERVAL_FAR,
          .sampler = &frame_same_texel },
        { 0 },
    };
    struct rg_pass *passes = pass_arena_alloc(builder, 5 * sizeof(*passes));
    if (!passes)
        return (struct rg_technique){ 0 };
    struct rg_pass *far_first =
        peel_all(passes, builder, near, "ice_interval.first", "ice_interval.next");
    struct rg_pass *last =
        peel_all(far_first, builder, far, "ice_interval.middle", "ice_interval.last");
    passes->uses = globals_use;
    passes->frag = &ice_interval_first_frag;
    /* the first layer of `far` lies behind the last layer of `near` */
    far_first->uses = use_before(builder, near, (struct rg_range){ .layer = near->layers - 1 });
    far_first->frag = &ice_interval_next_frag;
    *last = count;
    last->uses = pass_arena_join_uses(builder, (const struct rg_use *const[]){ count_uses }, 1);
    return (struct rg_technique){ "ice_interval", passes, (size_t)(last + 1 - passes) };
}

static const struct setting rows[] = {
    {
        SETTING_FIELD("ice_interval.count", COUNT, struct ice_interval_params, count),
        .label = "Ray intervals for crack clipping",
        .initial = 4,
        .min = 1,
        .max = ICE_INTERVAL_MAX,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "maximum number of intervals of a ray inside a concave object, for "
                "cracks.clip=interval",
    },
};

SETTING_GROUP(ice_interval, rows, struct ice_interval_params);

uint32_t ice_interval_index(const struct settings *settings)
{
    const struct ice_interval_params *params = settings_of(settings, &ice_interval_settings);
    return params->count - 1;
}

static const struct frame_layer layers[] = {
    {
        .name = "intervals",
        .image = &ice_interval_count,
        .planes = { "intervals.Z" },
        .shown = FRAME_SHOWN_AMOUNT,
        .help = "number of intervals of the primary ray inside the ice",
    },
    { 0 },
};

const struct technique ice_interval = {
    .name = "ice_interval",
    .help = "intervals of primary rays inside the ice, by depth peeling",
    .pass_groups = { { PHASE_DEPTHS, .make_passes = make_passes } },
    .layers = layers,
};
