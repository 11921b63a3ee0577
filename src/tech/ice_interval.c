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

#define LAYERS(k) \
    { \
        .name = "ice_interval.layers", .format = VK_FORMAT_D32_SFLOAT, .layers = 2 * (k) \
    }

const struct rg_image ice_interval_layers[ICE_INTERVAL_MAX] = {
    LAYERS(1), LAYERS(2), LAYERS(3), LAYERS(4), LAYERS(5), LAYERS(6), LAYERS(7), LAYERS(8),
};

/* Both kinds of faces, nearest first, into the layers from `first_layer` on. */
#define PEEL(k, first_layer) \
    .depth = { &ice_interval_layers[(k)-1], \
               RG_LOAD_CLEAR, \
               { .depthStencil = { 1.0f, 0 } }, \
               .layer = (first_layer) }, \
    .depth_compare = VK_COMPARE_OP_LESS, .vert = &ice_depth_vert, .vertices = &frame_mesh_layout, \
    .record = frame_draw_object

#define USE(k, ...) \
    { \
        .image = &ice_interval_layers[(k)-1], .access = RG_SAMPLED, \
        .binding = ICE_INTERVAL_LAYERS, .here = true, __VA_ARGS__ \
    }

#define ROWS(k) \
    { \
        { \
            .name = "ice_interval.first", \
            PEEL(k, 0), \
            .uses = RG_USES(FRAME_USE_GLOBALS), \
            .frag = &ice_interval_first_frag, \
        }, \
            { \
                .name = "ice_interval.next", \
                .repeat = RG_PER_LAYER, \
                PEEL(k, 1), \
                .uses = RG_USES(FRAME_USE_GLOBALS, USE(k, .range = { .each = true })), \
                .frag = &ice_interval_next_frag, \
            }, \
            { \
                .name = "ice_interval.count", \
                .color = RG_TARGETS({ &ice_interval_count, RG_LOAD_DISCARD }), \
                .uses = RG_USES(USE(k, .range = { 0 })), \
                .vert = &screen_vert, \
                .frag = &ice_interval_count_frag, \
                .record = record_count, \
            }, \
    }

static const struct rg_pass passes[ICE_INTERVAL_MAX][3] = {
    ROWS(1), ROWS(2), ROWS(3), ROWS(4), ROWS(5), ROWS(6), ROWS(7), ROWS(8),
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

#define TECHNIQUE(k) \
    { \
        .graph = RG_TECHNIQUE("ice_interval", passes[(k)-1]), .settings = &ice_interval_settings, \
        .help = "the intervals of each ray that lie inside the ice" \
    }

const struct technique ice_interval[ICE_INTERVAL_MAX] = {
    TECHNIQUE(1), TECHNIQUE(2), TECHNIQUE(3), TECHNIQUE(4),
    TECHNIQUE(5), TECHNIQUE(6), TECHNIQUE(7), TECHNIQUE(8),
};

uint32_t ice_interval_index(const struct settings *settings)
{
    const struct ice_interval_params *params = settings_of(settings, &ice_interval_settings);
    return params->count - 1;
}
