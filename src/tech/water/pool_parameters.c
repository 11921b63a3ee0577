/*
 * pool_parameters.c: settings of a pool of water: waves, ground, floating ice. water.c draws the
 * pool; caustics.c lights it. The default absorption is measured for pure water at 650, 550 and 450
 * nm (Pope and Fry 1997).
 */
#include "src/tech/water/pool_parameters.h"
#include "src/tech/frame_resources.h"
#include "src/tech/refract/refract.h"

struct water_push pool_push_of(const struct settings *settings)
{
    const struct water_params *params = settings_of(settings, &water_settings);
    const struct pool_params *pool = settings_of(settings, &pool_settings);
    struct water_push push = { *params, *pool };
    push.water.ior /= REFRACT_IOR_AIR;
    return push;
}

bool pool_has_ice(const struct settings *settings)
{
    const struct pool_params *pool = settings_of(settings, &pool_settings);
    return pool->ice > 0.0f;
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
        SETTING_FIELD("water.wave", CHOICE, struct water_params, wave),
        .label = "Wave function",
        .initial = WATER_SERIES,
        .max = WATER_COSINE,
        .choices = waves,
        .help = "wave function: a series of waves, or one cosine along x",
    },
    WATER(height, .label = "Wave height", .initial = 0.01, .max = 1,
          .help = "wave height; 0: flat"),
    WATER(frequency, .label = "Wave frequency", .initial = 10, .max = 1000,
          .help = "wave frequency of the first octave"),
    WATER(amplitude, .label = "First octave amplitude", .initial = 1, .min = 0.01, .max = 100,
          .help = "amplitude of the first octave of the wave series; each further octave has half "
                  "the amplitude"),
    WATER(speed, .label = "Wave speed", .initial = 2, .min = -100, .max = 100,
          .unit = "radians per second", .help = "speed of the waves"),
    {
        SETTING_FIELD("water.octaves", COUNT, struct water_params, octaves),
        .label = "Wave octaves",
        .initial = 5,
        .max = 8,
        .help = "number of octaves of the wave series",
    },
    WATER(scale, .label = "Wave scale", .initial = 2.6, .min = 0.01, .max = 1000, .unit = "metres",
          .help = "length scale of the waves; larger values make the waves longer and higher"),
    WATER(ior, .label = "Refractive index", .initial = 1.333, .min = 1.001, .max = 4,
          .help = "refractive index of the water"),
    WATER(red, .label = "Absorption, red", .initial = 0.34, .max = 100, .unit = "1/metre",
          .help = "absorption coefficient of the water for red light"),
    WATER(green, .label = "Absorption, green", .initial = 0.0565, .max = 100, .unit = "1/metre",
          .help = "absorption coefficient of the water for green light"),
    WATER(blue, .label = "Absorption, blue", .initial = 0.0092, .max = 100, .unit = "1/metre",
          .help = "absorption coefficient of the water for blue light"),
};

SETTING_GROUP(water, rows, struct water_params);

#define POOL(field, ...) \
    { \
        .name = "pool." #field, .type = SETTING_FLOAT, \
        .offset = offsetof(struct pool_params, field), .unit = "metres", __VA_ARGS__ \
    }

static const struct setting pool_rows[] = {
    {
        SETTING_FIELD("pool.water", SWITCH, struct pool_params, water),
        .label = "Pool",
        .max = 1,
        .help = "replace the object with a pool of water (on in the scene 'pool')",
    },
    POOL(size, .label = "Pool size", .initial = 4, .min = 0.1, .max = 100,
         .affects = SETTING_AFFECTS_SCENE, .help = "side length of the pool"),
    POOL(depth, .label = "Pool depth", .initial = 1.2, .min = 0.01, .max = 100,
         .affects = SETTING_AFFECTS_SCENE, .help = "depth of the pool's water"),
    POOL(tile, .label = "Tile size", .initial = 0.25, .min = 0.01, .max = 100,
         .help = "side length of the pool's tiles"),
    POOL(ice, .label = "Floating ice", .max = 50, .affects = SETTING_AFFECTS_SCENE,
         .help = "width of the ice that floats in the pool (0 for none)"),
};

SETTING_GROUP(pool, pool_rows, struct pool_params);

static void follow_scene(struct settings *settings, const struct scene *scene)
{
    settings_set_value(settings, settings_row(&pool_settings, offsetof(struct pool_params, water)),
                       scene->has_pool);
}

const struct technique pool_parameters = {
    .name = "pool",
    .help = "waves and ground of a pool",
    .settings = &pool_settings,
    .follow_scene = follow_scene,
};
