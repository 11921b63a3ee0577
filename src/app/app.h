/* app.h: the program's commands, and the parsed command-line options. */
#ifndef FIRN_APP_APP_H
#define FIRN_APP_APP_H

#include <stdbool.h>
#include <stdio.h>
#include "graph/rg_profile.h"
#include "src/base/status.h"
#include "src/frame/output_layers.h"
#include "src/gpu/gpu.h"
#include "src/gpu/gpu_swapchain.h"
#include "src/metric/layer_comparison.h"
#include "src/reader/reader_process.h"
#include "src/render/pixel_filter.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

enum {
    APP_OUTPUT_COUNT = 16,      /* maximum number of -o options */
    APP_POSITIONAL_COUNT = 256, /* positional arguments, including the final NULL */
    APP_SWEEP_COUNT = 4,        /* maximum number of --sweep */
    APP_SBATCH_COUNT = 16,      /* maximum number of --sbatch */
    APP_NODE_COUNT = 16,        /* maximum number of --material NODE=... */
    APP_LADDER_SCENE_COUNT = 8, /* scenes of firn ladder */
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

/* Initial visibility of the control panels in a viewer window. */
enum app_overlay {
    APP_OVERLAY_AUTO, /* visible without --frames and --screenshot */
    APP_OVERLAY_ON,   /* also in --screenshot's PNG files */
    APP_OVERLAY_OFF,
};

/* A vector option, such as --eye X,Y,Z. */
struct app_vector {
    bool is_given;
    vec3s value;
};

/* Options that describe the scene. */
struct app_scene {
    const char *name; /* SCENE; NULL if it is missing */
    const char *environment, *surroundings, *material;
    const char *cracks;                 /* crack model file; NULL: generated */
    const char *bump, *bump_mask, *air; /* image files; NULL: generated */
    struct material_override material_overrides[APP_NODE_COUNT];
    uint32_t material_override_count;
    const char *animation; /* name or number of an animation, or "none"; NULL selects the first */
    struct model_transform model_transform;
    bool has_transform;           /* set by an option */
    bool has_default_environment; /* `environment` is the asset's default */
    float env_rotate;             /* degrees */
    float env_exposure;           /* stops */
    bool no_background;           /* alpha 0 instead of a background */
    struct app_vector background; /* linear */
    struct reader_params reader;
    struct settings settings;
    struct settings user_settings; /* without those that the scene sets */
    const char *preset;            /* file, or NULL */
    bool quiet;                    /* print no notes */
    bool plain;                    /* no inclusions, bumps and highlights */
};

/* Options that describe the rendered image of a scene. */
struct app_image {
    struct app_scene scene;
    const struct technique *refraction; /* bounce until app_choose_refraction() */
    bool is_refraction_named;           /* by --refraction or in the window */
    const struct technique *split;      /* model of side B, or NULL */
    uint32_t width, height, samples;
    bool is_adaptive;             /* adaptive sampling: adaptive_sampling.h */
    uint32_t level_samples;       /* samples of --quality; 0 if unset */
    bool level_has_smooth_filter; /* --quality selects a smooth filter */
    bool is_filter_named;
    enum pixel_filter filter;
    uint32_t columns, rows;         /* number of tiles; 0 without tiling */
    uint32_t tile;                  /* number from 1; 0 for all */
    bool interleaved;               /* tiles are interleaved: renderer.h */
    bool all_layers;                /* --aov all: app_parse() sets `layers` */
    uint32_t layers;                /* bit i: techniques_layer(i) */
    uint32_t png_bits;              /* bits per channel; 0 means 8 */
    const struct frame_layer *show; /* PNG layer; NULL: tone-mapped image */
    const char *camera;             /* name or number; NULL if unset */
    struct app_vector eye, target;
    struct app_vector orbit; /* azimuth, elevation (degrees), distance (metres) */
    float fov_deg;           /* 0: the model camera's, or 45 */
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
    char *const *args;   /* from the command on; NULL-terminated */
};

/* Options of firn render. Of these, firn farm accepts only --frames. */
struct app_render {
    const char *frames;          /* unparsed; NULL: a single image */
    uint32_t chunk, chunk_count; /* chunk number from 1; 0: all */
    bool resume;
    bool keep_sums;        /* see sample_sums_file.h */
    double noise, seconds; /* noise and time limits of the path tracer; 0 means no limit */
    const char *json;      /* report file, or NULL */
};

/* Options of firn view. */
struct app_view {
    uint32_t frame_count; /* frames to show; 0: no limit */
    uint32_t fps_limit;   /* frames per second; 0: no limit */
    double time_step;     /* scene seconds; 0: real time */
    const char *watch;    /* shader folder to watch, or NULL */
    VkPresentModeKHR present;
    enum app_overlay overlay;
    float ui_scale;      /* panel scale; 0: the desktop's */
    uint32_t theme;      /* index into app_themes */
    const char *ui_dump; /* file of control positions, or NULL */
    const char *session; /* session file, or NULL */
};

/* Options of firn profile. */
struct app_profile {
    enum rg_clock clock; /* RG_CLOCK_NONE: chosen by a test */
    uint32_t warmup, run_count;
    double time_step;                      /* seconds of scene time per run */
    const char *json, *csv, *trace, *html; /* report files, or NULL */
    const char *baseline;                  /* profile to compare with, or NULL */
    bool each, capture;
};

/* Options of firn profile and firn sheet. */
struct app_sweeps {
    const char *texts[APP_SWEEP_COUNT]; /* "name=a,b,c" */
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
    bool whole;                  /* with the inclusions of ice */
    const char *reference_image; /* image file, or NULL */
};

/* Options of firn farm. */
struct app_farm {
    uint32_t task_count; /* job count; 0: one per frame */
    const char *hosts;   /* ssh hosts; NULL: this machine */
    const char *sbatch[APP_SBATCH_COUNT];
    uint32_t sbatch_count;
    bool submit;
};

/* All command-line options; app_parse() sets the defaults that are not zero. */
struct app_options {
    struct app_image image;
    struct app_run run;
    const char *positionals[APP_POSITIONAL_COUNT]; /* other arguments, NULL-terminated */
    struct app_render render;
    struct app_view view;
    struct app_profile profile;
    struct app_sweeps sweeps;
    struct app_mask mask;
    struct app_diff diff;
    struct app_ladder ladder;
    struct app_farm farm;
};

/* Names of the window's colour themes, NULL-terminated. */
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

/* Parses the arguments after the command. Logs an error in one line and returns STATUS_USAGE. If
 * help is requested, prints it and sets *done. */
MUST_USE enum status app_parse(struct app_options *options, enum app_command command, int argc,
                               char **argv, bool *done);

/* Prints only the arguments of a command that firn render also accepts, without the first `skip`
 * positional arguments. Each argument is preceded by a space and quoted for a shell. */
void app_print_render_arguments(char *const *args, enum app_command command, uint32_t skip,
                                FILE *out);

/* Prints the help of a command on stdout. */
void app_help(enum app_command command);

enum status app_render(const struct app_options *options);
enum status app_graph(const struct app_options *options);
enum status app_info(const struct app_options *options);
enum status app_list(const struct app_options *options);
enum status app_profile(const struct app_options *options);
/* Replaces this process by firn-view. Returns only on failure, which is logged. */
enum status app_view(const struct app_options *options);
enum status app_diff(const struct app_options *options);
enum status app_ladder(const struct app_options *options);
enum status app_bake(const struct app_options *options);
enum status app_sheet(const struct app_options *options);
enum status app_farm(const struct app_options *options);
enum status app_merge(const struct app_options *options);

/* Sets an image option ("size") or a setting ("cracks.count") by its name. `value` has the syntax
 * of the command line. On failure logs and returns STATUS_USAGE. */
MUST_USE enum status app_set_option(struct app_image *image, const char *name, const char *value);

/* Adds the command's default output file if the options name no output. */
void app_default_output(struct app_options *o, enum app_command command);

/* Checks that SCENE is given. If not, logs and returns STATUS_USAGE. */
MUST_USE enum status app_require_scene(const struct app_scene *options);

struct bump_maps_params;

/* Returns scene parameters with pointers to `maps` and `options`, which must outlive them. */
struct scene_params app_scene_params(const struct app_scene *options,
                                     struct bump_maps_params *maps);

/* Loads the scene that the options name. An animated model is posed at motion.time. Also chooses
 * the settings that depend on the scene, such as refract.ior. */
MUST_USE enum status app_load_scene(struct scene *scene, struct app_scene *options);

struct asset;
/* Returns the default environment for a scene name, or NULL for the built-in sky. */
const struct asset *app_default_environment(const char *name);

/* Writes a loaded scene's default settings to `options`. Settings given by the user are kept. */
void app_apply_scene_settings(struct app_scene *options, const struct scene *scene);

/* Returns a loaded scene's settings without changes by --set, --preset, --plain or the user. */
struct settings app_scene_settings(const struct app_scene *options, const struct scene *scene);

/* Begins to load a scene. After success, only a lack of memory can make app_fill_scene() fail. */
MUST_USE enum status app_begin_scene(struct scene *scene, struct app_scene *options);
/* Does the slow part of loading. Other threads may read the scene meanwhile. Returns the name of
 * the data that did not fit in memory, or NULL on success. */
MUST_USE const char *app_fill_scene(struct scene *scene, const struct app_scene *options);
/* Logs that memory ran out for `lacking`, named by app_fill_scene(). Returns STATUS_TRY_AGAIN. */
enum status app_log_fill_failure(const char *lacking);

/* Poses an animated model at `time`, in seconds, by reloading and filling the scene. Does nothing
 * if the scene is not animated or already has this pose. The scene must not be in use. On failure
 * the scene is unchanged. */
MUST_USE enum status app_pose_scene(struct scene *scene, const struct app_scene *options,
                                    float time, bool *is_changed);

/* Chooses the refraction model of a loaded scene unless one is named: bounce for one closed
 * refractive object that it draws without approximation, seen from outside, else trace. Logs a note
 * if it is trace (unless quiet), and warnings of what the model leaves out that the reference
 * draws. `camera` is that of the first frame; NULL if it is outside all objects. */
void app_choose_refraction(struct app_image *image, const struct scene *scene,
                           const struct camera *camera);

/* Logs a warning if trace.traversal asks for ray queries that the device does not support. */
void app_check_rays(const struct settings *settings, const struct gpu *gpu);

/* Finds the camera that the options or the model set, else makes one that frames the object. */
MUST_USE enum status app_camera(struct camera *camera, const struct scene *scene,
                                const struct app_image *p);

struct renderer_params;

/* Returns renderer parameters that point into `image`. The caller must add the sample count and the
 * outputs. */
struct renderer_params app_renderer_params(const struct app_image *p, struct gpu *gpu,
                                           const struct scene *scene);

#endif
