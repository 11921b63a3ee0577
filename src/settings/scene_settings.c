/* scene_settings.c: tables of scene settings, apart from those of rendering techniques. */
#include "src/settings/scene_settings.h"
#include "shaders/globals.h"
#include "src/scene/generate/generate.h"

static const struct setting object_rows[] = {
    {
        .name = "object.triangles",
        .label = "Triangle count",
        .type = SETTING_COUNT,
        .offset = offsetof(struct object_params, triangles),
        .max = GENERATE_TRIANGLES_MAX,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "triangle count of a built-in object (0: default of sphere 960, ice 4800, teapot "
                "14400)",
    },
};

SETTING_GROUP(object, object_rows, struct object_params);

static const struct setting ice_rows[] = {
    {
        .name = "ice.melt",
        .label = "Melted",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct ice_params, melt),
        .max = 1,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "fraction of the ice's volume melted at time 0; melting makes the ice rounder and "
                "wet and enlarges its pool",
    },
};

SETTING_GROUP(ice, ice_rows, struct ice_params);

static const struct setting landscape_rows[] = {
    {
        .name = "landscape.triangles",
        .label = "Landscape triangles",
        .type = SETTING_COUNT,
        .offset = offsetof(struct landscape_params, triangles),
        .max = GENERATE_TRIANGLES_MAX,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "triangle count of the landscape (0: default of 2340)",
    },
    {
        .name = "landscape.flat",
        .label = "Flat floor",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct landscape_params, flat),
        .max = 1,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "level tiled floor under the object instead of the valley",
    },
};

SETTING_GROUP(landscape, landscape_rows, struct landscape_params);

static const struct setting sky_rows[] = {
    {
        .name = "sky.strength",
        .label = "Sky brightness",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct sky_params, strength),
        .initial = 1,
        .max = 100,
        .help = "brightness of the procedural sky and its light",
    },
    {
        .name = "sky.sun_azimuth",
        .label = "Sun azimuth",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct sky_params, sun_azimuth),
        .initial = 60,
        .min = -360,
        .max = 360,
        .unit = "degrees",
        .help = "azimuth of the sun; 0 is +Z, 90 is +X",
    },
    {
        .name = "sky.sun_elevation",
        .label = "Sun elevation",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct sky_params, sun_elevation),
        .initial = 35,
        .min = -90,
        .max = 90,
        .unit = "degrees",
        .help = "elevation of the sun above the horizon",
    },
    {
        .name = "sky.sun_strength",
        .label = "Sun brightness",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct sky_params, sun_strength),
        .initial = 1,
        .max = 100,
        .help = "brightness of the procedural sky's sun",
    },
};

SETTING_GROUP(sky, sky_rows, struct sky_params);

static const char *const env_suns[] = {
    [ENV_SUN_FILE] = "file",
    [ENV_SUN_CUSTOM] = "own",
    [ENV_SUN_NONE] = "none",
    NULL,
};

static const char *const env_sun_labels[] = {
    [ENV_SUN_FILE] = "in the picture",
    [ENV_SUN_CUSTOM] = "set below",
    [ENV_SUN_NONE] = "none",
};

static const struct setting env_rows[] = {
    {
        .name = "env.sun",
        .label = "Sun of the panorama",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct env_params, sun),
        .max = ENV_SUN_NONE,
        .choices = env_suns,
        .choice_labels = env_sun_labels,
        .help = "sun of the --env panorama: file (stored in the file), own (at env.sun_azimuth and "
                "env.sun_elevation), or none",
    },
    {
        .name = "env.sun_strength",
        .label = "Panorama sun brightness",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct env_params, sun_strength),
        .initial = 1,
        .max = 1000,
        .help = "factor on the brightness of the panorama's sun; with env.sun=own, brightness of a "
                "white sun",
    },
    {
        .name = "env.sun_azimuth",
        .label = "Panorama sun azimuth",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct env_params, sun_azimuth),
        .initial = 60,
        .min = -360,
        .max = 360,
        .unit = "degrees",
        .help = "azimuth of the sun that env.sun=own places in the panorama; 0 is +Z, 90 is +X",
    },
    {
        .name = "env.sun_elevation",
        .label = "Panorama sun elevation",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct env_params, sun_elevation),
        .initial = 35,
        .min = -90,
        .max = 90,
        .unit = "degrees",
        .help = "elevation above the horizon of the sun that env.sun=own places in the panorama",
    },
    {
        .name = "env.blur",
        .label = "Background blur",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct env_params, blur),
        .max = 45,
        .unit = "degrees",
        .help = "angle by which the panorama is blurred where it is visible directly, not in "
                "reflections and through refraction; the reference does not blur it",
    },
};

SETTING_GROUP(env, env_rows, struct env_params);

static const struct setting texture_rows[] = {
    {
        .name = "texture.anisotropy",
        .label = "Anisotropic filtering",
        .type = SETTING_COUNT,
        .offset = offsetof(struct texture_params, anisotropy),
        .initial = 4,
        .min = 1,
        .max = 16,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "maximum anisotropy of texture filtering (1: off, fastest on CPUs)",
    },
};

SETTING_GROUP(texture, texture_rows, struct texture_params);

#define MOTION(field, ...) \
    { \
        .name = "motion." #field, .type = SETTING_FLOAT, \
        .offset = offsetof(struct motion_params, field), __VA_ARGS__ \
    }

static const struct setting motion_rows[] = {
    MOTION(time, .label = "Start time", .min = -1e5, .max = 1e5, .unit = "seconds",
           .help = "scene time of frame 0"),
    MOTION(fps, .label = "Frames per second", .initial = 25, .min = 0.01, .max = 1e4,
           .help = "frames per second of scene time"),
    MOTION(ice, .label = "Turntable", .initial = 20, .min = -3600, .max = 3600,
           .unit = "degrees per second", .help = "rotation speed of the ice"),
    MOTION(lights, .label = "Light orbit speed", .initial = 30, .min = -3600, .max = 3600,
           .unit = "degrees per second", .help = "orbit speed of the lights around the ice"),
    MOTION(objects, .label = "Object orbit speed", .initial = 40, .min = -3600, .max = 3600,
           .unit = "degrees per second", .help = "orbit speed of the objects around the ice"),
    MOTION(melt, .label = "Melts by", .max = 1e3, .affects = SETTING_AFFECTS_SCENE,
           .unit = "half widths per second",
           .help = "speed at which the ice's faces retreat as it melts"),
    {
        .name = "motion.count",
        .label = "Orbiting objects",
        .type = SETTING_COUNT,
        .offset = offsetof(struct motion_params, count),
        .max = GENERATE_ORBITING_BALLS_MAX,
        .affects = SETTING_AFFECTS_SCENE,
        .help = "number of objects that move around the ice",
    },
};

SETTING_GROUP(motion, motion_rows, struct motion_params);

#define LIGHT(field, ...) \
    { \
        .name = "light." #field, .type = SETTING_FLOAT, \
        .offset = offsetof(struct light_params, field), __VA_ARGS__ \
    }

static const struct setting light_rows[] = {
    {
        .name = "light.count",
        .label = "Lights",
        .type = SETTING_COUNT,
        .offset = offsetof(struct light_params, count),
        .initial = 2,
        .max = GLOBALS_LIGHT_COUNT,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "number of lights around the ice, visible only as highlights on it",
    },
    LIGHT(strength, .label = "Light brightness", .initial = 1, .max = 100,
          .switches = SETTING_AFFECTS_PLAN, .help = "brightness of the lights' highlights"),
    LIGHT(azimuth, .label = "Light azimuth", .initial = 60, .min = -360, .max = 360,
          .unit = "degrees", .help = "azimuth of the first light at time 0; 0 is +Z, 90 is +X"),
    LIGHT(elevation, .label = "Light elevation", .initial = 50, .min = -90, .max = 90,
          .unit = "degrees", .help = "elevation of the lights above the horizon"),
    LIGHT(distance, .label = "Light distance", .initial = 4, .min = 1, .max = 1e4, .unit = "radii",
          .help = "distance of the lights, in radii of the ice's bounding sphere"),
};

SETTING_GROUP(light, light_rows, struct light_params);

static const struct setting env_cube_rows[] = {
    {
        .name = "env_cube.dynamic",
        .label = "Update environment cube",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct env_cube_params, dynamic),
        .initial = 1,
        .max = 1,
        .affects = SETTING_AFFECTS_PLAN,
        .help =
            "update the environment cube map as the scene changes (off: draw once, at motion.time)",
    },
    {
        .name = "env_cube.always",
        .label = "Redraw whole cube every frame",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct env_cube_params, always),
        .max = 1,
        .help = "redraw the environment cube every frame (off: only if it changes)",
    },
    {
        .name = "env_cube.size",
        .label = "Environment cube resolution",
        .type = SETTING_COUNT,
        .offset = offsetof(struct env_cube_params, size),
        .min = 16,
        .max = 2048,
        .has_auto = true,
        .unit = "texels",
        .affects = SETTING_AFFECTS_PLAN,
        .help = "size of the environment cube's faces; larger ones are sharper through the ice "
                "(auto: from the image height, 128 to 2048)",
    },
};

SETTING_GROUP(env_cube, env_cube_rows, struct env_cube_params);

static const char *const ground_lights[] = {
    [GROUND_UNOCCLUDED] = "open",
    [GROUND_TRACED] = "traced",
    NULL,
};

static const char *const ground_shadings[] = {
    [GROUND_VERTICES] = "vertices",
    [GROUND_PIXELS] = "pixels",
    NULL,
};

static const struct setting ground_rows[] = {
    {
        .name = "ground.light",
        .label = "Ground lighting",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct ground_params, light),
        .max = GROUND_TRACED,
        .choices = ground_lights,
        .affects = SETTING_AFFECTS_PLAN,
        .help =
            "lighting of surroundings: open (unoccluded), or traced (soft shadows and one-bounce "
            "indirect light, also through ice; refraction models trace and reference)",
    },
    {
        .name = "ground.shading",
        .label = "Ground shading",
        .type = SETTING_CHOICE,
        .offset = offsetof(struct ground_params, shading),
        .initial = GROUND_PIXELS,
        .max = GROUND_PIXELS,
        .choices = ground_shadings,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "shading of surroundings with materials: pixels, or vertices (faster, without bump "
                "maps and reflections of objects; used while the view in a window moves)",
    },
    {
        .name = "ground.denoise",
        .renamed_from = "ground.smooth",
        .label = "Denoise ground lighting",
        .type = SETTING_SWITCH,
        .offset = offsetof(struct ground_params, denoise),
        .max = 1,
        .affects = SETTING_AFFECTS_PLAN,
        .help =
            "trace fewer rays for ground.light=traced and denoise their light; for output files "
            "with --refraction trace, fewer than 32 samples and no tiles",
    },
};

SETTING_GROUP(ground, ground_rows, struct ground_params);

static const struct setting lens_rows[] = {
    {
        .name = "lens.f_stop",
        .label = "Aperture (f-number; 0: all sharp)",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct lens_params, f_stop),
        .max = 1000,
        .help = "f-number of the lens for a 36 mm wide sensor; smaller values blur more and "
                "need more --samples (0: pinhole, no depth of field)",
    },
    {
        .name = "lens.focus",
        .label = "Focus distance",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct lens_params, focus),
        .max = 1e6,
        .unit = "metres",
        .help = "focus distance along the camera's axis (0: centre of the objects)",
    },
};

SETTING_GROUP(lens, lens_rows, struct lens_params);

static const struct setting target_rows[] = {
    {
        .name = "inclusions.scale",
        .renamed_from = "target.scale",
        .label = "Inclusion resolution",
        .type = SETTING_FLOAT,
        .offset = offsetof(struct inclusion_target_params, scale),
        .initial = 1,
        .min = 0.125,
        .max = 1,
        .affects = SETTING_AFFECTS_PLAN,
        .help = "resolution of cracks, air and bubbles relative to the final image (below 1: "
                "faster, but coarser)",
    },
};

SETTING_GROUP(inclusions, target_rows, struct inclusion_target_params);
