/* app.h: the program's commands, and the parsed command-line options. */
#ifndef FIRN_APP_APP_H
#define FIRN_APP_APP_H

#include <stdbool.h>
#include <stdio.h>
#include "graph/rg_time.h"
#include "src/base/status.h"
#include "src/frame/output_layers.h"
#include "src/gpu/gpu.h"
#include "src/gpu/gpu_swapchain.h"
#include "src/metric/comparison.h"
#include "src/reader/reader.h"
#include "src/render/pixel_filter.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

enum {
    APP_OUTPUT_COUNT = 16,      /* maximum number of -o options */
    APP_POSITIONAL_COUNT = 256, /* arguments that are not options, including the final NULL */
    APP_SWEEP_COUNT = 4,        /* maximum number of --sweep */
    APP_SBATCH_COUNT = 16,      /* maximum number of --sbatch */
    APP_NODE_COUNT = 16,        /* maximum number of --material NODE=... */
    APP_LADDER_SCENE_COUNT = 8, /* maximum number of scenes of firn ladder */
};

#define APP_UI_SCALE_MIN 0.5f /* range of --ui-scale */
#define APP_UI_SCALE_MAX 4.0f

/* Output format of commands that print. */
enum app_format {
    APP_FORMAT_TEXT,
    APP_FORMAT_DOT,
    APP_FORMAT_JSON,
    APP_FORMAT_HTML,
    APP_FORMAT_PRESET,
    APP_FORMAT_COUNT,
};

/* Initial visibility of the panels in a window. */
enum app_overlay {
    APP_OVERLAY_AUTO, /* visible if the window is interactive: without --frames and --screenshot */
    APP_OVERLAY_ON,   /* also in the PNG files of --screenshot */
    APP_OVERLAY_OFF,
};

/* A vector that an option may give. */
struct app_vector {
    bool is_given;
    vec3s value;
};

/* Options that describe the scene. */
struct app_scene {
    const char *name; /* SCENE; NULL if it is missing */
    const char *environment, *surroundings, *material;
    const char *cracks;                 /* model file of a crack; NULL: generated cracks */
    const char *bump, *bump_mask, *air; /* image files; NULL: generated */
    struct material_override material_overrides[APP_NODE_COUNT];
    uint32_t material_override_count;
    const char *animation; /* name of an animation, or "none"; NULL: the model's first one */
    struct model_transform model_transform; /* transform of the model file */
    bool is_placed;                         /* `place` was set by an option */
    bool has_own_environment;     /* `environment` is the asset's default, not set by an option */
    float env_rotate;             /* degrees */
    float env_exposure;           /* stops */
    bool no_background;           /* images have alpha 0 instead of a background */
    struct app_vector background; /* linear */
    struct reader_params reader;
    struct settings settings;
    struct settings stated; /* for the window: settings of options and user, not the scene's */
    const char *preset;     /* file; NULL if there is none */
    bool is_set[SETTINGS_FIELD_COUNT], is_preset[SETTINGS_FIELD_COUNT]; /* by --set, by --preset */
    bool is_own[SETTINGS_FIELD_COUNT];                                  /* set by the asset */
    bool quiet;                                                         /* print no notes */
    bool plain; /* without inclusions and bumps of ice, and without highlights */
};

/* Options that describe the rendered image of a scene. */
struct app_image {
    struct app_scene scene;
    const struct technique
        *refraction;          /* refraction model; bounce until app_choose_refraction() chooses */
    bool is_refraction_named; /* by --refraction, or by the user of a window */
    const struct technique *split; /* model right of a window's divider; NULL if there is none */
    uint32_t width, height, samples;
    bool is_adaptive;             /* adaptive sampling: adaptive.h */
    uint32_t level_samples;       /* samples of --quality, unless --samples is given; 0: none */
    bool level_has_smooth_filter; /* --quality asks for a smooth pixel filter */
    bool is_filter_named;
    enum pixel_filter filter;
    uint32_t columns, rows;         /* tiles that the image is drawn in; 0: drawn whole */
    uint32_t tile;                  /* the only tile to draw, from 1; 0: all */
    bool interleaved;               /* tiles are interleaved: renderer.h */
    bool all_layers;                /* app_parse() sets the bits of all drawn layers in `layers` */
    uint32_t layers;                /* bit i: techniques_layer(i) */
    uint32_t png_bits;              /* bits per channel; 0 means 8 */
    const struct frame_layer *show; /* layer in PNG files; NULL: the tone-mapped image */
    const char *camera; /* name or number of a camera of the model; NULL if none is named */
    struct app_vector eye, target;
    struct app_vector orbit; /* azimuth, elevation (degrees), distance (metres) */
    float fov_deg;           /* 0: that of the model's camera, or 45 */
    enum rg_sharing sharing;
};

struct app_outputs {
    const char *paths[APP_OUTPUT_COUNT];
    uint32_t count;
};

/* Device, output files and format of a command. */
struct app_run {
    struct gpu_params gpu;
    struct app_outputs outputs;
    enum app_format format;
    bool quiet;
    const char *program; /* argv[0] */
    char *const *words;  /* command line from the command on; ends at NULL */
};

/* Options of firn render; firn farm passes all but json on. */
struct app_render {
    const char *frames;          /* not parsed yet; NULL: a single image */
    uint32_t chunk, chunk_count; /* chunk of the frames, from 1; 0: all frames */
    bool resume;
    bool keep_sums;        /* store the sample sums of the reference: sample_sums_file.h */
    double noise, seconds; /* limits at which the reference stops; 0: only its sample count */
    const char *json;      /* report file; NULL if there is none */
};

/* Options of firn view. */
struct app_view {
    uint32_t frame_count; /* number of frames until the window closes; 0 means no limit */
    uint32_t fps_limit;   /* frames per second; 0: no limit */
    double time_step;     /* seconds of scene time per frame; 0: real time */
    const char *watch;    /* folder of shaders to reload; NULL if there is none */
    VkPresentModeKHR present;
    enum app_overlay overlay;
    float ui_scale;      /* scale of the panels; 0: that of the desktop */
    uint32_t theme;      /* index into app_themes */
    const char *ui_dump; /* file for the positions of controls; NULL if there is none */
    const char *session; /* session file to open; NULL if there is none */
};

/* Options of firn profile. */
struct app_profile {
    enum rg_clock clock; /* RG_CLOCK_NONE: chosen by testing the device's timestamps */
    uint32_t warmup, run_count;
    double time_step;                      /* seconds of scene time per run */
    const char *json, *csv, *trace, *html; /* report files; NULL if not wanted */
    const char *baseline;                  /* profile to compare with; NULL if there is none */
    bool each, capture;
};

/* Options of firn profile and firn sheet. */
struct app_sweeps {
    const char *words[APP_SWEEP_COUNT]; /* "name=a,b,c" */
    uint32_t count;
};

/* Options of firn diff and of firn ladder --truth. */
struct app_mask {
    const char *file, *channel; /* NULL: all pixels, "A" */
};

/* Options of firn diff. */
struct app_diff {
    bool has_exposure;
    float exposure; /* stops */
    bool only_heat; /* PNG files show only the errors */
    float ppd;      /* pixels per degree; 0: FLIP_PPD */
    enum flip_curve curve;
    bool has_limit[COMPARISON_METRIC_COUNT];
    double limits[COMPARISON_METRIC_COUNT];
};

/* Options of firn ladder. */
struct app_ladder {
    uint32_t refraction_models; /* bit i: techniques_refraction(i); 0: all */
    uint32_t run_count;         /* timed frames per refraction model */
    bool furnace;
    bool whole;        /* with the inclusions of ice */
    const char *truth; /* image file; NULL if there is none */
};

/* Options of firn farm. */
struct app_farm {
    uint32_t task_count; /* number of jobs; 0: one per frame, up to FARM_TASKS */
    const char *hosts;   /* ssh hosts for GNU parallel; NULL: this machine */
    const char *sbatch[APP_SBATCH_COUNT];
    uint32_t sbatch_count;
    bool submit;
};

/* All command-line options; app_parse() sets the defaults that are not zero. */
struct app_options {
    struct app_image picture;
    struct app_run run;
    const char *positionals[APP_POSITIONAL_COUNT]; /* arguments other than SCENE; end at NULL */
    struct app_render render;
    struct app_view view;
    struct app_profile profile;
    struct app_sweeps sweeps;
    struct app_mask mask;
    struct app_diff diff;
    struct app_ladder ladder;
    struct app_farm farm;
};

/* Names of the window's colour themes; ends at NULL. */
extern const char *const app_themes[];

enum app_command {
    APP_RENDER = 1,
    APP_GRAPH = 2,
    APP_LIST = 4,
    APP_VIEW = 8,
    APP_PROFILE = 16,
    APP_DIFF = 32,
    APP_LADDER = 64,
    APP_BAKE = 128,
    APP_SHEET = 256,
    APP_FARM = 512,
    APP_MERGE = 1024,
    APP_INFO = 2048,
};

/*
 * Parses the arguments after the command. Logs an error in one line and returns STATUS_USAGE. If
 * help is requested, prints it and sets *done.
 */
MUST_USE enum status app_parse(struct app_options *options, enum app_command command, int argc,
                               char **argv, bool *done);

/*
 * Prints those arguments of a command that firn render accepts, too, quoted, each after a space.
 * The first `skip` arguments that are not options are left out.
 */
void app_print_render_arguments(char *const *words, enum app_command command, uint32_t skip,
                                FILE *out);

/* Prints the help of a command on stdout. */
void app_help(enum app_command command);

enum status app_render(const struct app_options *options);
enum status app_graph(const struct app_options *options);
enum status app_info(const struct app_options *options);
enum status app_list(const struct app_options *options);
enum status app_profile(const struct app_options *options);
/* replaces this process by firn-view if it can */
enum status app_view(const struct app_options *options);
enum status app_diff(const struct app_options *options);
enum status app_ladder(const struct app_options *options);
enum status app_bake(const struct app_options *options);
enum status app_sheet(const struct app_options *options);
enum status app_farm(const struct app_options *given);
enum status app_merge(const struct app_options *options);

/*
 * Sets an option of the image ("size", "material") or a setting ("cracks.count") by its name, as
 * the command line would. On failure logs and returns STATUS_USAGE.
 */
MUST_USE enum status app_set_option(struct app_image *picture, const char *name, const char *value);

/* Sets the default output file of a command if none is named. */
void app_default_output(struct app_options *o, enum app_command command);

/* Checks that SCENE is given. If not, logs and returns STATUS_USAGE. */
MUST_USE enum status app_require_scene(const struct app_scene *given);

struct bump_maps_params;

/* Returns the scene parameters for the options; it points to `maps` and into the options. */
struct scene_params app_scene_params(const struct app_scene *given, struct bump_maps_params *maps);

/* Loads the scene that the options name, posed at motion.time if it is animated, and sets the
 * settings that depend on it, such as refract.ior. */
MUST_USE enum status app_load_scene(struct scene *scene, struct app_scene *given);

/* Returns the default environment of a scene of this name; NULL: the built-in sky. */
struct asset;
const struct asset *app_own_environment(const char *name);

/* Applies the settings of a loaded scene, except where options set other values. */
void app_apply_scene_settings(struct app_scene *given, const struct scene *scene);

/* Returns a loaded scene's own settings, without options and changes by the user. */
struct settings app_scene_settings(const struct app_scene *given, const struct scene *scene);

/*
 * Load a scene in two steps. The first finds all errors. The second only takes time, and may run in
 * parallel with code that reads the result of the first. It logs nothing, and returns NULL or what
 * there was no memory for; app_log_fill_failure() then logs that and returns STATUS_TRY_AGAIN.
 */
MUST_USE enum status app_begin_scene(struct scene *scene, struct app_scene *given);
MUST_USE const char *app_fill_scene(struct scene *scene, const struct app_scene *given);
enum status app_log_fill_failure(const char *lacking);

/*
 * Poses an animated model of app_begin_scene(), which is at time 0, for another time, seconds:
 * reloads the model and fills the scene. Does nothing for other scenes, or if the time is the same.
 * The scene must not be in use. On failure it is unchanged.
 */
MUST_USE enum status app_pose_scene(struct scene *scene, const struct app_scene *given, float time,
                                    bool *is_changed);

/*
 * Chooses the refraction model of a loaded scene unless one is named: bounce for one closed
 * refractive object that it draws without approximation, seen from outside, else trace. Logs a note
 * if it is trace (unless quiet), and warnings of what the model leaves out that the reference
 * draws. `camera` is that of the first frame; NULL if it is outside all objects.
 */
void app_choose_refraction(struct app_image *picture, const struct scene *scene,
                           const struct camera *camera);

/* Logs a warning if trace.traversal asks for ray queries and the device has none. */
void app_check_rays(const struct settings *settings, const struct gpu *gpu);

/* Finds the camera: the model's of that name, else its first, else one that frames the object. */
MUST_USE enum status app_camera(struct camera *camera, const struct scene *scene,
                                const struct app_image *picture);

struct renderer_params;

/* Returns parameters for renderers of the image, in tiles if requested. The caller sets samples and
 * outputs. Points into the picture. */
struct renderer_params app_renderer_params(const struct app_image *picture, struct gpu *gpu,
                                           const struct scene *scene);

#endif
