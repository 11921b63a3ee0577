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
#include "src/tech/background.h"
#include "src/tech/caustics.h"
#include "src/tech/frame.h"
#include "src/tech/gbuffer.h"
#include "src/tech/refract.h"

static rg_record_fn record_surface, record_ice;

#define SURFACE \
    .vert = &water_vert, .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, \
    .push_size = sizeof(struct water_push), .record = record_surface

#define USE_ENVIRONMENT \
    { \
        .image = &frame_environment, .access = RG_SAMPLED, .binding = WATER_ENVIRONMENT, \
        .sampler = &frame_environment_sampler, \
    }

#define GBUFFER_ROW \
    { \
        .name = "water.gbuffer", \
        .color = \
            RG_TARGETS({ &gbuffer_normal, RG_LOAD_KEEP }, { &gbuffer_position, RG_LOAD_KEEP }), \
        .depth = { &gbuffer_depth, RG_LOAD_KEEP }, .depth_compare = VK_COMPARE_OP_GREATER, \
        .uses = RG_USES(FRAME_USE_GLOBALS), .frag = &water_gbuffer_frag, SURFACE, \
    }

#define USE_CAUSTICS \
    { \
        .image = &caustics_light, .access = RG_SAMPLED, .binding = WATER_CAUSTICS, \
        .sampler = &frame_linear, \
    }

/* Where the ice is: shaders/refract_inside.glsl. */
#define USE_ICE \
    REFRACT_USE_NORMAL_BACK, REFRACT_USE_DEPTH_BACK, REFRACT_USE_NORMAL_FRONT, \
        REFRACT_USE_DEPTH_FRONT

#define COLOR_TARGETS \
    .color = RG_TARGETS({ &background_color, RG_LOAD_KEEP }), \
    .depth = { &background_depth, RG_LOAD_KEEP }, .depth_compare = VK_COMPARE_OP_GREATER

#define COLOR_ROW(shader, ...) \
    { \
        .name = "water.color", COLOR_TARGETS, .uses = RG_USES(FRAME_USE_GLOBALS, __VA_ARGS__), \
        .frag = (shader), SURFACE, \
    }

/* What of it stands out of the water. */
#define ICE_ROW(shader, ...) \
    { \
        .name = "water.ice", COLOR_TARGETS, .uses = RG_USES(FRAME_USE_GLOBALS, __VA_ARGS__), \
        .frag = (shader), REFRACT_FRONT_FACES, .push_size = sizeof(struct water_push), \
        .record = record_ice, \
    }

#define LAYERS_ROW(shader, ...) \
    { \
        .name = "water.layers", .color = RG_TARGETS({ &caustics_seen, RG_LOAD_CLEAR }), \
        .depth = { &background_depth, RG_LOAD_KEEP }, .depth_read_only = true, \
        .depth_compare = VK_COMPARE_OP_GREATER_OR_EQUAL, \
        .uses = RG_USES(FRAME_USE_GLOBALS, __VA_ARGS__), .frag = (shader), SURFACE, \
    }

static const struct rg_pass passes[] = {
    GBUFFER_ROW,
    COLOR_ROW(&water_frag, USE_ENVIRONMENT),
};

static const struct rg_pass lit_passes[] = {
    GBUFFER_ROW,
    COLOR_ROW(&water_caustics_frag, USE_ENVIRONMENT, USE_CAUSTICS),
    LAYERS_ROW(&water_caustics_aov_frag, USE_ENVIRONMENT, USE_CAUSTICS),
};

static const struct rg_pass iced_passes[] = {
    GBUFFER_ROW,
    COLOR_ROW(&water_iced_frag, USE_ENVIRONMENT, USE_ICE),
    ICE_ROW(&water_ice_frag, USE_ENVIRONMENT, USE_ICE),
};

static const struct rg_pass iced_lit_passes[] = {
    GBUFFER_ROW,
    COLOR_ROW(&water_iced_caustics_frag, USE_ENVIRONMENT, USE_CAUSTICS, USE_ICE),
    ICE_ROW(&water_ice_caustics_frag, USE_ENVIRONMENT, USE_CAUSTICS, USE_ICE),
    LAYERS_ROW(&water_iced_caustics_aov_frag, USE_ENVIRONMENT, USE_CAUSTICS, USE_ICE),
};

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
    return pool->water && pool->ice > 0.0f;
}

bool water_is_on(const struct settings *settings)
{
    const struct pool_params *pool = settings_of(settings, &pool_settings);
    return pool->water;
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
    POOL(size, .initial = 4, .min = 0.1, .max = 100, .help = "length of the pool's sides"),
    POOL(depth, .initial = 1.2, .min = 0.01, .max = 100, .help = "depth of its water"),
    POOL(tile, .initial = 0.25, .min = 0.01, .max = 100, .help = "length of its tiles' sides"),
    POOL(ice, .max = 50, .help = "width of the ice that floats in it (0: none)"),
};

const struct setting_group pool_settings = SETTING_GROUP("pool", pool_rows, struct pool_params);

static const struct technique techniques[2][2] = {
    {
        {
            .graph = RG_TECHNIQUE("water", passes),
            .settings = &water_settings,
            .help = "a pool of water and the ground below it",
        },
        {
            .graph = RG_TECHNIQUE("water", lit_passes),
            .settings = &water_settings,
            .help = "the same under the light of caustics",
        },
    },
    {
        {
            .graph = RG_TECHNIQUE("water", iced_passes),
            .settings = &water_settings,
            .help = "a pool in which ice floats",
        },
        {
            .graph = RG_TECHNIQUE("water", iced_lit_passes),
            .settings = &water_settings,
            .help = "the same under the light of caustics",
        },
    },
};

const struct technique *water_find(const struct settings *settings)
{
    return &techniques[water_has_ice(settings)][caustics_find(settings) != NULL];
}
