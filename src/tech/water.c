/*
 * water.c: a pool of water: waves, what they mirror, and the ground that they refract.
 *
 * Waves are those of shaders/lib/wave.glsl, with exact normals. The surface is drawn as a grid; at
 * each pixel the ray is refracted once, meets the floor or a wall of the box exactly, and loses by
 * Beer and Lambert's law what its path through the water absorbs. Shares by Fresnel's equations.
 * The sun's light comes down as through water at rest, and is uneven as src/tech/caustics.c says.
 *
 * Absorption by default is that of pure water (Pope and Fry 1997) at 650, 550 and 450 nm.
 *
 * Limits: no ray meets a second wave; the reflection has the sky and the pool's dry walls, not what
 * stands around it; the ground does not light itself, nor the surface from below, which stands for
 * the loss of radiance by the square of the index that light has when it leaves water. The eye is
 * above the water.
 *
 * Ice that floats in it (pool.ice) is drawn above the water, and met by rays below, by the maps of
 * ice_normal.c in the eye's view, with the bends that air and water at rest give it. The limits
 * are those of refract_bounce.c, and: colours do not part; the ice mirrors nothing but the sky and
 * the dry walls, the water no ice; no ray meets the ice twice; sun and waves are as if it were not
 * there.
 */
#include "src/tech/water.h"
#include "shaders/embedded.h"
#include "src/tech/caustics.h"
#include "src/tech/frame.h"
#include "src/tech/gbuffer.h"
#include "src/tech/ice_normal.h"
#include "src/tech/refract.h"
#include "src/tech/row_builder.h"

static rg_record_fn record_surface, record_ice;

static const struct rg_use surface_uses[] = {
    FRAME_USE_GLOBALS,
    FRAME_SAMPLE(frame_environment, WATER_ENVIRONMENT, .sampler = &frame_environment_sampler),
    { 0 },
};

static const struct rg_use caustics_uses[] = {
    FRAME_SAMPLE(caustics_light, WATER_CAUSTICS, .sampler = &frame_linear),
    { 0 },
};

/* Where the ice is: shaders/refract_inside.glsl. */
static const struct rg_use ice_uses[] = {
    FRAME_SAMPLE(ice_normal_back, REFRACT_NORMAL_BACK, .sampler = &frame_linear),
    FRAME_READ(ice_normal_back_depth, REFRACT_DEPTH_BACK),
    FRAME_SAMPLE(ice_normal_front, REFRACT_NORMAL_FRONT, .sampler = &frame_linear),
    FRAME_READ(ice_normal_front_depth, REFRACT_DEPTH_FRONT),
    { 0 },
};

static const struct rg_pass gbuffer_row = {
    .name = "water.gbuffer",
    .color = RG_TARGETS({ &gbuffer_normal, RG_LOAD_KEEP }, { &gbuffer_position, RG_LOAD_KEEP }),
    .depth = { &gbuffer_depth, RG_LOAD_KEEP },
    .depth_compare = VK_COMPARE_OP_GREATER,
    .uses = RG_USES(FRAME_USE_GLOBALS),
    .vert = &water_vert,
    .frag = &water_gbuffer_frag,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
    .push_size = sizeof(struct water_push),
    .record = record_surface,
};

static const struct rg_pass color_row = {
    .name = "water.color",
    .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_compare = VK_COMPARE_OP_GREATER,
    .vert = &water_vert,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
    .push_size = sizeof(struct water_push),
    .record = record_surface,
};

/* What of the ice stands out of the water. */
static const struct rg_pass ice_row = {
    .name = "water.ice",
    .color = RG_TARGETS({ &frame_color, RG_LOAD_KEEP }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_compare = VK_COMPARE_OP_GREATER,
    .vert = &refract_vert,
    .vertices = &frame_mesh_layout,
    .cull = VK_CULL_MODE_BACK_BIT,
    .push_size = sizeof(struct water_push),
    .record = record_ice,
};

static const struct rg_pass layers_row = {
    .name = "water.layers",
    .color = RG_TARGETS({ &caustics_seen, RG_LOAD_CLEAR }),
    .depth = { &frame_depth, RG_LOAD_KEEP },
    .depth_read_only = true,
    .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL,
    .vert = &water_vert,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
    .push_size = sizeof(struct water_push),
    .record = record_surface,
};

enum {
    ROW_COUNT = 4
};

/* Shaders for water without and with ice, in plain light and in that of caustics. */
static const struct rg_shader *const color_frags[2][2] = {
    { &water_frag, &water_caustics_frag },
    { &water_iced_frag, &water_iced_caustics_frag },
};
static const struct rg_shader *const ice_frags[2] = { &water_ice_frag, &water_ice_caustics_frag };
static const struct rg_shader *const layers_frags[2] = {
    &water_caustics_aov_frag,
    &water_iced_caustics_aov_frag,
};

static struct rg_technique make_rows(const struct technique_choice *choice,
                                     struct row_builder *builder)
{
    const bool lit = caustics_are_lit(choice->settings);
    const bool iced = water_has_ice(choice->settings);
    const struct rg_use *const lists[] = { surface_uses, lit ? caustics_uses : NULL,
                                           iced ? ice_uses : NULL };
    const struct rg_use *uses = row_builder_uses(builder, lists, 3);
    struct rg_pass *rows = row_builder_alloc(builder, ROW_COUNT * sizeof(*rows));
    if (!rows)
        return (struct rg_technique){ 0 };
    struct rg_pass *row = rows;
    *row++ = gbuffer_row;
    *row = color_row;
    row->uses = uses;
    row++->frag = color_frags[iced][lit];
    if (iced) {
        *row = ice_row;
        row->uses = uses;
        row++->frag = ice_frags[lit];
    }
    if (lit) {
        *row = layers_row;
        row->uses = uses;
        row++->frag = layers_frags[iced];
    }
    return (struct rg_technique){ "water", rows, (size_t)(row - rows) };
}

struct water_push water_push_of(const struct settings *settings)
{
    const struct water_params *params = settings_of(settings, &water_settings);
    const struct pool_params *pool = settings_of(settings, &pool_settings);
    struct water_push push = { *params, *pool };
    push.water.ior /= REFRACT_IOR_AIR;
    return push;
}

bool water_has_ice(const struct settings *settings)
{
    const struct pool_params *pool = settings_of(settings, &pool_settings);
    return pool->ice > 0.0f;
}

static void record_surface(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct water_push push = water_push_of(frame->settings);
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw(cmd, WATER_GRID * (2 * WATER_GRID + 4));
}

static void record_ice(struct rg_cmd *cmd, const struct rg_frame *frame)
{
    const struct water_push push = water_push_of(frame->settings);
    rg_cmd_push(cmd, &push, sizeof(push));
    rg_cmd_draw_mesh(cmd, &frame->object);
}

static const char *const waves[] = {
    [WATER_SERIES] = "series",
    [WATER_COSINE] = "cosine",
    NULL,
};

#define WATER(field, ...) \
    { \
        .name = "water." #field, .type = SETTING_FLOAT, \
        .offset = offsetof(struct water_params, field), __VA_ARGS__ \
    }

static const struct setting rows[] = {
    {
        .name = "water.wave",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct water_params, wave),
        .initial = WATER_SERIES,
        .max = WATER_COSINE,
        .choices = waves,
        .help = "a series of waves, or one cosine along x",
    },
    WATER(height, .initial = 0.01, .max = 1, .help = "how high waves are: V (0: flat)"),
    WATER(frequency, .initial = 10, .max = 1000, .help = "how many there are: W"),
    WATER(amplitude, .initial = 1, .min = 0.01, .max = 100,
          .help = "F of the series: its octaves are F, F/2, F/4 ... high"),
    WATER(speed, .initial = 2, .min = -100, .max = 100, .unit = "radians a second",
          .help = "how fast waves change: S"),
    {
        .name = "water.octaves",
        .type = SETTING_COUNT,
        .offset = offsetof(struct water_params, octaves),
        .initial = 5,
        .max = 8,
        .help = "of the series",
    },
    WATER(scale, .initial = 2.6, .min = 0.01, .max = 1000, .unit = "metres",
          .help = "length of a unit of the waves"),
    WATER(ior, .initial = 1.333, .min = 1.001, .max = 4, .help = "refractive index of the water"),
    WATER(red, .initial = 0.34, .max = 100, .unit = "1/metres", .help = "absorption of red light"),
    WATER(green, .initial = 0.0565, .max = 100, .unit = "1/metres",
          .help = "absorption of green light"),
    WATER(blue, .initial = 0.0092, .max = 100, .unit = "1/metres",
          .help = "absorption of blue light"),
};

const struct setting_group water_settings = SETTING_GROUP("water", rows, struct water_params);

#define POOL(field, ...) \
    { \
        .name = "pool." #field, .type = SETTING_FLOAT, \
        .offset = offsetof(struct pool_params, field), .unit = "metres", __VA_ARGS__ \
    }

static const struct setting pool_rows[] = {
    {
        .name = "pool.water",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct pool_params, water),
        .max = 1,
        .help = "a pool of water in place of the object; the scene pool switches it on",
    },
    POOL(size, .initial = 4, .min = 0.1, .max = 100, .affects = SETTING_AFFECTS_SCENE,
         .help = "length of the pool's sides"),
    POOL(depth, .initial = 1.2, .min = 0.01, .max = 100, .affects = SETTING_AFFECTS_SCENE,
         .help = "depth of its water"),
    POOL(tile, .initial = 0.25, .min = 0.01, .max = 100, .help = "length of its tiles' sides"),
    POOL(ice, .max = 50, .affects = SETTING_AFFECTS_SCENE,
         .help = "width of the ice that floats in it (0: none)"),
};

const struct setting_group pool_settings = SETTING_GROUP("pool", pool_rows, struct pool_params);

const struct technique water = {
    .name = "water",
    .help = "a pool of water and the ground below it",
    .settings = { &pool_settings, &water_settings },
    .parts = { { PHASE_REFRACTION, SCENE_OF_POOL, .rows = make_rows } },
};
