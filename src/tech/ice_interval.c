/*
 * ice_interval.c: the intervals of each pixel's ray that lie inside the ice.
 *
 * Seipel and Nivfors 2006 take the nearest front and the farthest back face for the two ends of one
 * interval, which is right for convex objects only. Depth peeling (Everitt 2001) finds all faces in
 * their order: each layer draws the object once more and keeps the nearest of what lies behind the
 * layer before. Depth is fitted to the object, as in ice_depth.
 *
 * The object must be closed. What lies behind the last layer counts as outside.
 */
#include "src/tech/ice_interval.h"
#include "shaders/embedded.h"
#include "src/frame.h"

static rg_record_fn record_count;

const struct rg_image ice_interval_count = {
    .name = "ice_interval.count",
    .format = VK_FORMAT_R32_SFLOAT,
};

#define LAYERS(title, k) \
    { \
        .name = (title), .format = VK_FORMAT_D32_SFLOAT, .layers = (k), .array = true \
    }
#define NEAR(k) LAYERS("ice_interval.near", k)
#define FAR(k)  LAYERS("ice_interval.far", k)

const struct rg_image ice_interval_near[ICE_INTERVAL_MAX] = {
    NEAR(1), NEAR(2), NEAR(3), NEAR(4), NEAR(5), NEAR(6), NEAR(7), NEAR(8),
};

const struct rg_image ice_interval_far[ICE_INTERVAL_MAX] = {
    FAR(1), FAR(2), FAR(3), FAR(4), FAR(5), FAR(6), FAR(7), FAR(8),
};

/* Both kinds of faces, nearest first, into the layers from `first_layer` on. */
#define PEEL(layers_, first_layer) \
    .depth = { &(layers_), \
               RG_LOAD_CLEAR, \
               { .depthStencil = { 1.0f, 0 } }, \
               .layer = (first_layer) }, \
    .depth_compare = VK_COMPARE_OP_LESS, .vert = &ice_depth_vert, .vertices = &frame_mesh_layout, \
    .record = frame_draw_object

#define USE(layers_, binding_, ...) \
    { \
        .image = &(layers_), .access = RG_SAMPLED, .binding = (binding_), .same_texel = true, \
        __VA_ARGS__ \
    }
#define BEHIND(layers_, ...) \
    .uses = RG_USES(FRAME_USE_GLOBALS, USE(layers_, ICE_INTERVAL_BEFORE, .range = __VA_ARGS__)), \
    .frag = &ice_interval_next_frag

#define FIRST(k) \
    { \
        .name = "ice_interval.first", PEEL(ice_interval_near[(k)-1], 0), \
        .uses = RG_USES(FRAME_USE_GLOBALS), .frag = &ice_interval_first_frag \
    }
#define NEXT(title, layers_) \
    { \
        .name = (title), .repeat = RG_PER_LAYER, PEEL(layers_, 1), \
        BEHIND(layers_, { .each = true }) \
    }
/* Behind the last layer of the nearer ones. */
#define MIDDLE(k) \
    { \
        .name = "ice_interval.middle", PEEL(ice_interval_far[(k)-1], 0), \
        BEHIND(ice_interval_near[(k)-1], { .layer = (k)-1 }) \
    }
#define COUNT(k) \
    { \
        .name = "ice_interval.count", \
        .color = RG_TARGETS({ &ice_interval_count, RG_LOAD_DISCARD }), \
        .uses = RG_USES(USE(ice_interval_near[(k)-1], ICE_INTERVAL_NEAR, .range = { 0 }), \
                        USE(ice_interval_far[(k)-1], ICE_INTERVAL_FAR, .range = { 0 })), \
        .vert = &screen_vert, .frag = &ice_interval_count_frag, .record = record_count \
    }

/* One layer near and one far. */
static const struct rg_pass one_passes[] = { FIRST(1), MIDDLE(1), COUNT(1) };

#define ROWS(k) \
    { \
        FIRST(k), NEXT("ice_interval.next", ice_interval_near[(k)-1]), MIDDLE(k), \
            NEXT("ice_interval.last", ice_interval_far[(k)-1]), COUNT(k) \
    }

/* The others: [k - 2]. */
static const struct rg_pass passes[ICE_INTERVAL_MAX - 1][5] = {
    ROWS(2), ROWS(3), ROWS(4), ROWS(5), ROWS(6), ROWS(7), ROWS(8),
};

static void record_count(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    (void)frame;
    rg_cmd_draw(cmd, 3);
}

static const struct setting rows[] = {
    {
        .name = "ice_interval.count",
        .type = SETTING_COUNT,
        .offset = offsetof(struct ice_interval_params, count),
        .initial = 4,
        .min = 1,
        .max = ICE_INTERVAL_MAX,
        .help = "how often a ray can enter a concave object, for cracks.clip=interval",
    },
};

const struct setting_group ice_interval_settings =
    SETTING_GROUP("ice_interval", rows, struct ice_interval_params);

#define TECHNIQUE(table) \
    { \
        .graph = RG_TECHNIQUE("ice_interval", table), .settings = &ice_interval_settings, \
        .help = "the intervals of each ray that lie inside the ice" \
    }

const struct technique ice_interval[ICE_INTERVAL_MAX] = {
    TECHNIQUE(one_passes), TECHNIQUE(passes[0]), TECHNIQUE(passes[1]), TECHNIQUE(passes[2]),
    TECHNIQUE(passes[3]),  TECHNIQUE(passes[4]), TECHNIQUE(passes[5]), TECHNIQUE(passes[6]),
};

uint32_t ice_interval_index(const struct settings *settings)
{
    const struct ice_interval_params *params = settings_of(settings, &ice_interval_settings);
    return params->count - 1;
}
