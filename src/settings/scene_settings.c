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
        .help = "triangles of the landscape (0: 2340)",
    },
    {
        .name = "landscape.flat",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct landscape_params, flat),
        .max = 1,
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
        .help = "lights around the ice, whose highlights it shows",
    },
    LIGHT(strength, .initial = 1, .max = 100, .help = "brightness of their highlights"),
    LIGHT(azimuth, .initial = 60, .min = -360, .max = 360, .unit = "degrees",
          .help = "direction of the first light at time 0; 0 on +Z, 90 on +X"),
    LIGHT(elevation, .initial = 50, .min = -90, .max = 90, .unit = "degrees",
          .help = "height of the lights above the horizon"),
    LIGHT(distance, .initial = 4, .min = 1, .max = 1e4, .unit = "radii",
          .help = "how far away they are, in radii of the ice's bounding sphere"),
};

const struct setting_group light_settings = SETTING_GROUP("light", light_rows, struct light_params);

#define ABSORB(field) \
    { \
        .name = "absorb." #field, .type = SETTING_FLOAT, \
        .offset = offsetof(struct absorb_params, field), .max = 1e4, .unit = "1/metre", \
        .help = "how fast the object takes " #field " light" \
    }

static const struct setting absorb_rows[] = {
    ABSORB(red),
    ABSORB(green),
    ABSORB(blue),
};

const struct setting_group absorb_settings =
    SETTING_GROUP("absorb", absorb_rows, struct absorb_params);

#define LOCAL(field, what) \
    { \
        .name = "local." #field, .type = SETTING_FLOAT, \
        .offset = offsetof(struct local_params, field), .min = -1e6, .max = 1e6, .unit = "metres", \
        .help = "of refract.lookup=box: " what " of its box (all 0: what the surroundings need)" \
    }

static const struct setting local_rows[] = {
    LOCAL(left, "least x"),   LOCAL(right, "greatest x"), LOCAL(bottom, "least y"),
    LOCAL(top, "greatest y"), LOCAL(back, "least z"),     LOCAL(front, "greatest z"),
};

const struct setting_group local_settings = SETTING_GROUP("local", local_rows, struct local_params);
