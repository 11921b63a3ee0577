/* app.h: the program's subcommands and what their options say. */
#ifndef FIRN_APP_APP_H
#define FIRN_APP_APP_H

#include <stdbool.h>
#include <stdio.h>
#include "graph/rg_time.h"
#include "src/base/status.h"
#include "src/frame/layers.h"
#include "src/gpu/gpu.h"
#include "src/gpu/gpu_swapchain.h"
#include "src/metric/comparison.h"
#include "src/reader/reader.h"
#include "src/render/pixel_filter.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

enum {
    APP_OUTPUT_COUNT = 16,      /* -o options at most */
    APP_POSITIONAL_COUNT = 256, /* words that are not options, and NULL */
    APP_SWEEP_COUNT = 4,        /* --sweep */
    APP_SBATCH_COUNT = 16,      /* --sbatch */
    APP_NODE_COUNT = 16,        /* --material NODE=... */
    APP_LADDER_SCENE_COUNT = 8, /* of firn ladder; all but the first are positionals */
};

#define APP_UI_SCALE_MIN 0.5f /* --ui-scale */
#define APP_UI_SCALE_MAX 4.0f

/* How a command prints what it prints. */
enum app_format {
    APP_FORMAT_TEXT,
    APP_FORMAT_DOT,
    APP_FORMAT_JSON,
    APP_FORMAT_HTML,
    APP_FORMAT_PRESET,
    APP_FORMAT_COUNT,
};

/* Whether panels lie over a window's picture when it opens. */
enum app_overlay {
    APP_OVERLAY_AUTO, /* if hands may use them: without --frames and --screenshot */
    APP_OVERLAY_ON,   /* and in the PNG files of --screenshot */
    APP_OVERLAY_OFF,
};

/* A vector that an option may give. */
struct app_vector {
    bool is_given;
    vec3s value;
};

/* What is drawn. */
struct app_scene {
    const char *name; /* SCENE; NULL: it is missing */
    const char *environment, *surroundings, *material;
    const char *cracks;                 /* model file of a crack; NULL: cracks are made */
    const char *bump, *bump_mask, *air; /* pictures; NULL: the same */
    struct node_material node_materials[APP_NODE_COUNT];
    uint32_t node_material_count;
    const char *animation;        /* of the model file, or "none"; NULL: its first one, if any */
    struct place place;           /* of the model file */
    bool is_placed;               /* by an option */
    bool has_own_environment;     /* it is the asset's, and not said by an option */
    float env_rotate;             /* degrees */
    float env_exposure;           /* stops */
    bool no_background;           /* pictures do not show it */
    struct app_vector background; /* linear */
    struct reader_params reader;
    struct settings settings;
    struct settings stated; /* of a window: what options and hands said, without a scene's own */
    const char *preset;     /* file; NULL: none */
    bool is_set[SETTINGS_FIELD_COUNT], is_preset[SETTINGS_FIELD_COUNT]; /* by --set, --preset */
    bool is_own[SETTINGS_FIELD_COUNT];                                  /* by the asset's row */
    bool quiet;                                                         /* no notes */
    bool plain; /* without what only ice has, and without highlights */
};

/* A picture of it, and how that is made. */
struct app_picture {
    struct app_scene scene;
    const struct technique *rung;  /* until app_choose_rung(), if nobody names one: bounce */
    bool is_rung_named;            /* by --refraction, or by hand in a window */
    const struct technique *split; /* on the right of a window; NULL: it is not split */
    uint32_t width, height, samples;
    bool adapts;            /* parts with little noise have fewer samples: adaptive.h */
    uint32_t level_samples; /* of --quality, which firn render has unless --samples says; 0: none */
    bool level_is_smooth;   /* the same of its pixel filter */
    bool is_filter_named;
    enum pixel_filter filter;
    uint32_t columns, rows;         /* of tiles that it is drawn in; 0: it is not */
    uint32_t tile;                  /* the one to draw, from 1; 0: all of them */
    bool interleaved;               /* tiles are so: renderer.h */
    bool all_layers;                /* that the rung makes; app_parse() puts them into: */
    uint32_t layers;                /* bit i: techniques_layer(i) */
    uint32_t png_bits;              /* of a channel; 0 means 8 */
    const struct frame_layer *show; /* what PNG files show; NULL: the tonemapped picture */
    const char *camera;             /* name or number of one of the model's; NULL: none is named */
    struct app_vector eye, target;
    struct app_vector orbit; /* azimuth, elevation (degrees), distance */
    float fov_deg;           /* 0: the model's, or 45 */
    enum rg_sharing sharing;
};

struct app_outputs {
    const char *paths[APP_OUTPUT_COUNT];
    uint32_t count;
};

/* What it is drawn on, and what is printed and written. */
struct app_run {
    struct gpu_params gpu;
    struct app_outputs outputs;
    enum app_format format;
    bool quiet;
    const char *program; /* as it was called */
    char *const *words;  /* of the command line, from the command on; ends at NULL */
};

/* Of firn render and, but for json, of what firn farm starts. */
struct app_render {
    const char *frames;          /* not parsed; NULL: one picture */
    uint32_t chunk, chunk_count; /* of frames, from 1; 0: all of them */
    bool resume;
    bool keep_sums;        /* of the reference, in sums_file.h's file */
    double noise, seconds; /* the reference ends by; 0: by its samples alone */
    const char *json;      /* file of a report; NULL: none */
};

/* Of firn view. */
struct app_view {
    uint32_t frame_count; /* ends after so many; 0: when the window is closed */
    uint32_t fps_limit;   /* frames a second; 0: none */
    double time_step;     /* seconds from frame to frame; 0: as time passes */
    const char *watch;    /* folder of shaders; NULL: none */
    VkPresentModeKHR present;
    enum app_overlay overlay;
    float ui_scale;      /* of the panels; 0: the desktop's */
    uint32_t theme;      /* index into app_themes */
    const char *ui_dump; /* file for the places of controls; NULL: none */
    const char *session; /* file to begin with; NULL: none */
};

/* Of firn profile. */
struct app_profile {
    enum rg_clock clock; /* to measure by; RG_CLOCK_NONE: what a test of the device finds */
    uint32_t warmup, run_count;
    double time_step;                      /* seconds from run to run */
    const char *json, *csv, *trace, *html; /* files of reports; NULL: not wanted */
    const char *baseline;                  /* file */
    bool each, capture;
};

/* Of firn profile and firn sheet. */
struct app_sweeps {
    const char *words[APP_SWEEP_COUNT]; /* "name=a,b,c" */
    uint32_t count;
};

/* Of firn diff and of firn ladder's truth. */
struct app_mask {
    const char *file, *channel; /* NULL: all pixels, "A" */
};

/* Of firn diff. */
struct app_diff {
    bool has_exposure;
    float exposure; /* stops */
    bool only_heat; /* PNG files have the errors alone */
    float ppd;      /* pixels per degree; 0: FLIP_PPD */
    enum flip_curve curve;
    bool has_limit[COMPARISON_METRIC_COUNT];
    double limits[COMPARISON_METRIC_COUNT];
};

/* Of firn ladder. */
struct app_ladder {
    uint32_t rungs;     /* bit i: techniques_rung(i); 0: all */
    uint32_t run_count; /* frames of each rung against the clock */
    bool furnace;
    bool whole;        /* with the inclusions of ice */
    const char *truth; /* file; NULL: none */
};

/* Of firn farm. */
struct app_farm {
    uint32_t task_count; /* 0: one for each frame, up to FARM_TASKS */
    const char *hosts;   /* of GNU parallel; NULL: this machine */
    const char *sbatch[APP_SBATCH_COUNT];
    uint32_t sbatch_count;
    bool submit;
};

/* What the command line says; app_parse() sets what is not zero by default. */
struct app_options {
    struct app_picture picture;
    struct app_run run;
    const char *positionals[APP_POSITIONAL_COUNT]; /* words that are not SCENE; end at NULL */
    struct app_render render;
    struct app_view view;
    struct app_profile profile;
    struct app_sweeps sweeps;
    struct app_mask mask;
    struct app_diff diff;
    struct app_ladder ladder;
    struct app_farm farm;
};

/* Colours of the window; ends at NULL. */
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
 * Parses the words after the command. What is wrong is logged in one line: STATUS_USAGE. Asked for
 * help it prints it and sets *done.
 */
MUST_USE enum status app_parse(struct app_options *options, enum app_command command, int argc,
                               char **argv, bool *done);

/*
 * Writes those of a command's words that firn render takes, too, quoted, with a space before each.
 * The first `skip` words that are no options are left out.
 */
void app_print_render_words(char *const *words, enum app_command command, uint32_t skip, FILE *out);

/* The help of a command, on stdout. */
void app_help(enum app_command command);

enum status app_render(const struct app_options *options);
enum status app_graph(const struct app_options *options);
enum status app_info(const struct app_options *options);
enum status app_list(const struct app_options *options);
enum status app_profile(const struct app_options *options);
enum status app_view(const struct app_options *options); /* becomes firn-view if it can */
enum status app_diff(const struct app_options *options);
enum status app_ladder(const struct app_options *options);
enum status app_bake(const struct app_options *options);
enum status app_sheet(const struct app_options *options);
enum status app_farm(const struct app_options *given);
enum status app_merge(const struct app_options *options);

/*
 * Sets what `name` means, an option that says what is drawn ("size", "material") or a setting
 * ("cracks.count"), as the command line would. Logs: STATUS_USAGE.
 */
MUST_USE enum status app_set(struct app_picture *picture, const char *name, const char *value);

/* Names the file that a command writes where none is named. */
void app_name_output(struct app_options *o, enum app_command command);

/* Whether it has a name. Logs: STATUS_USAGE. */
MUST_USE enum status app_need_scene(const struct app_scene *given);

struct bump_maps_params;

/* What the options say of the scene; the result points to `maps` and into the options. */
struct scene_params app_describe_scene(const struct app_scene *given,
                                       struct bump_maps_params *maps);

/* Loads the scene that the options name, an animated one as it is at motion.time, and settles what
 * depends on it: settings.refract.ior. */
MUST_USE enum status app_load_scene(struct scene *scene, struct app_scene *given);

/* What a scene of this name is in unless an option says another thing; NULL: the built-in sky. */
struct asset;
const struct asset *app_own_environment(const char *name);

/* Puts into settings, where nobody has said another value, what a scene brings, which is loaded. */
void app_settle_settings(struct app_scene *given, const struct scene *scene);

/* Returns what a scene, which is loaded, has by itself: without options and hands. */
struct settings app_own_settings(const struct app_scene *given, const struct scene *scene);

/*
 * The same in two parts: what can be wrong, and what only takes a while and may run beside others
 * that read the first. The second returns NULL, or what there was no memory for, and does not log:
 * app_fill_failed() does, and returns STATUS_TRY_AGAIN.
 */
MUST_USE enum status app_begin_scene(struct scene *scene, struct app_scene *given);
MUST_USE const char *app_fill_scene(struct scene *scene, const struct app_scene *given);
enum status app_fill_failed(const char *lacking);

/*
 * Poses a scene of app_begin_scene(), which is at time 0, for another time, seconds: loads an
 * animated model again, and fills the scene. Of others, and for the time that it is posed for,
 * nothing happens. Nothing may use the scene. On failure it is as before.
 */
MUST_USE enum status app_pose_scene(struct scene *scene, const struct app_scene *given, float time,
                                    bool *is_changed);

/*
 * Chooses the rung of a loaded scene unless one is named: bounce for one closed refractive object
 * that it draws as it is, seen from outside, else trace. Says so if it is trace (unless the options
 * are quiet), and what the rung leaves out that the reference draws. The camera, of the first
 * frame, may be NULL: it is outside.
 */
void app_choose_rung(struct app_picture *picture, const struct scene *scene,
                     const struct camera *camera);

/* Says once that a device has no ray queries where trace.rays asks for them. */
void app_check_rays(const struct settings *settings, const struct gpu *gpu);

/* The camera of the options, which may name one of the model's, else the model's first, else one
 * that frames the object. */
MUST_USE enum status app_camera(struct camera *camera, const struct scene *scene,
                                const struct app_picture *picture);

struct renderer_params;

/* For renderers of the picture, in tiles if it is; the caller says how many samples and what they
 * bring back. Points into the picture. */
struct renderer_params app_renderer_params(const struct app_picture *picture, struct gpu *gpu,
                                           const struct scene *scene);

#endif
