/* scene_settings.c: parameters of the scene that belong to no technique. */
#include "src/settings/scene_settings.h"
#include "shaders/globals.h"
#include "src/scene/generate/generate.h"

static const struct setting object_rows[] = {
    {
        .name = "object.triangles",
        .type = SETTING_COUNT,
        .offset = offsetof(struct object_params, triangles),
        .max = GENERATE_TRIANGLES_MAX,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "triangles of a built-in object (0: sphere 960, ice 4800, teapot 14400)",
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
        .affects = SETTING_AFFECTS_SCENE,
        .help = "triangles of the landscape (0: 2340)",
    },
    {
        .name = "landscape.flat",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct landscape_params, flat),
        .max = 1,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "a level floor of tiles under the object, in place of the valley",
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

static const struct setting texture_rows[] = {
    {
        .name = "texture.anisotropy",
        .type = SETTING_COUNT,
        .offset = offsetof(struct texture_params, anisotropy),
        .initial = 4,
        .min = 1,
        .max = 16,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "samples that textures seen at a slant may take (1: fast on CPUs)",
    },
};

const struct setting_group texture_settings =
    SETTING_GROUP("texture", texture_rows, struct texture_params);

#define MOTION(field, ...) \
    { \
        .name = "motion." #field, .type = SETTING_FLOAT, \
        .offset = offsetof(struct motion_params, field), __VA_ARGS__ \
    }

static const struct setting motion_rows[] = {
    MOTION(time, .min = -1e5, .max = 1e5, .unit = "seconds", .help = "time of frame 0"),
    MOTION(fps, .initial = 25, .min = 0.01, .max = 1e4, .help = "frames a second"),
    MOTION(ice, .initial = 20, .min = -3600, .max = 3600, .unit = "degrees a second",
           .help = "how fast the ice turns"),
    MOTION(lights, .initial = 30, .min = -3600, .max = 3600, .unit = "degrees a second",
           .help = "how fast the lights go around it"),
    MOTION(objects, .initial = 40, .min = -3600, .max = 3600, .unit = "degrees a second",
           .help = "how fast the objects around it move"),
    {
        .name = "motion.count",
        .type = SETTING_COUNT,
        .offset = offsetof(struct motion_params, count),
        .max = GENERATE_MOVERS_MAX,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "objects that move around the ice",
    },
};

const struct setting_group motion_settings =
    SETTING_GROUP("motion", motion_rows, struct motion_params);

#define LIGHT(field, ...) \
    { \
        .name = "light." #field, .type = SETTING_FLOAT, \
        .offset = offsetof(struct light_params, field), __VA_ARGS__ \
    }

static const struct setting light_rows[] = {
    {
        .name = "light.count",
        .type = SETTING_COUNT,
        .offset = offsetof(struct light_params, count),
        .initial = 2,
        .max = GLOBALS_LIGHT_COUNT,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "lights around the ice, whose highlights it shows",
    },
    LIGHT(strength, .initial = 1, .max = 100, .switches = SETTING_AFFECTS_PLAN,
          .help = "brightness of their highlights"),
    LIGHT(azimuth, .initial = 60, .min = -360, .max = 360, .unit = "degrees",
          .help = "direction of the first light at time 0; 0 on +Z, 90 on +X"),
    LIGHT(elevation, .initial = 50, .min = -90, .max = 90, .unit = "degrees",
          .help = "height of the lights above the horizon"),
    LIGHT(distance, .initial = 4, .min = 1, .max = 1e4, .unit = "radii",
          .help = "how far away they are, in radii of the ice's bounding sphere"),
};

const struct setting_group light_settings = SETTING_GROUP("light", light_rows, struct light_params);

static const struct setting env_cube_rows[] = {
    {
        .name = "env_cube.dynamic",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct env_cube_params, dynamic),
        .initial = 1,
        .max = 1,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "draw the environment cube as it changes (off: once, at motion.time)",
    },
    {
        .name = "env_cube.always",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct env_cube_params, always),
        .max = 1,
        .help = "and all six faces of it in every frame (off: those in which something changed)",
    },
    {
        .name = "env_cube.faces",
        .type = SETTING_COUNT,
        .offset = offsetof(struct env_cube_params, faces),
        .initial = 6,
        .min = 1,
        .max = 6,
        .help = "or at most so many a frame of a window, in turn",
    },
};

const struct setting_group env_cube_settings =
    SETTING_GROUP("env_cube", env_cube_rows, struct env_cube_params);
