/* scene_settings.c: parameters of the scene that belong to no technique. */
#include "src/scene_settings.h"
#include "src/scene/generate.h"

static const struct setting object_rows[] = {
    {
        .name = "object.triangles",
        .type = SETTING_COUNT,
        .offset = offsetof(struct object_params, triangles),
        .max = GENERATE_TRIANGLES_MAX,
        .help = "triangles of a built-in object (0: sphere 960, ice-cube 4800, teapot 14400)",
    },
};

const struct setting_group object_settings =
    SETTING_GROUP("object", object_rows, struct object_params);

static const struct setting landscape_rows[] = {
    {
        .name = "landscape.triangles",
        .type = SETTING_COUNT,
        .offset = offsetof(struct landscape_params, triangles),
        .max = GENERATE_TRIANGLES_MAX,
        .help = "triangles of the landscape (0: 2340)",
    },
};

const struct setting_group landscape_settings =
    SETTING_GROUP("landscape", landscape_rows, struct landscape_params);

static const struct setting sky_rows[] = {
    {
        .name = "sky.strength",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct sky_params, strength),
        .initial = 1,
        .max = 100,
        .help = "brightness of the procedural sky and its light",
    },
    {
        .name = "sky.sun_azimuth",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct sky_params, sun_azimuth),
        .initial = 60,
        .min = -360,
        .max = 360,
        .unit = "degrees",
        .help = "where the sun stands: 0 on +Z, 90 on +X",
    },
    {
        .name = "sky.sun_elevation",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct sky_params, sun_elevation),
        .initial = 35,
        .min = -90,
        .max = 90,
        .unit = "degrees",
        .help = "height of the sun above the horizon",
    },
    {
        .name = "sky.sun_strength",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct sky_params, sun_strength),
        .initial = 1,
        .max = 100,
        .help = "brightness of the sun",
    },
};

const struct setting_group sky_settings = SETTING_GROUP("sky", sky_rows, struct sky_params);
