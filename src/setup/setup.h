/* setup.h: converts options to the scene, settings, camera, refraction model and renderer
 * parameters of an image. The commands and the window use it. */
#ifndef FIRN_SETUP_SETUP_H
#define FIRN_SETUP_SETUP_H

#include <stdbool.h>
#include "src/file/reader_process.h"
#include "src/gpu/gpu.h"
#include "src/gpu/gpu_swapchain.h"
#include "src/render/frame/output_layers.h"
#include "src/render/pixel_filter.h"
#include "src/scene/scene.h"
#include "src/settings/settings.h"

enum {
    SETUP_OUTPUT_COUNT = 16, /* maximum number of -o options */
    SETUP_NODE_COUNT = 16,   /* maximum number of --material NODE=..., and of nodes to transform */
    SETUP_GROUND_NAME_SIZE = 64,
    SETUP_TRANSFORM_SIZE = MATERIAL_NAME_SIZE + 7 * 16,
};

#define SETUP_UI_SCALE_MIN 0.5f /* range of --ui-scale */
#define SETUP_UI_SCALE_MAX 4.0f

/* Initial visibility of the control panels in a viewer window. */
enum setup_overlay {
    SETUP_OVERLAY_AUTO, /* visible without --frames and --screenshot */
    SETUP_OVERLAY_ON,   /* also in --screenshot's PNG files */
    SETUP_OVERLAY_OFF,
};

/* A vector option, such as --orbit AZIMUTH,ELEVATION,DISTANCE. */
struct setup_vector {
    bool is_given;
    vec3s value;
};

/* A position option in the coordinates of the model's file, such as --eye X,Y,Z. */
struct setup_position {
    bool is_given;
    double value[3];
};

/* Exposure of the image: --exposure, and the exposure that was metered. */
struct setup_exposure {
    bool is_option; /* --exposure is given */
    bool is_auto;   /* --exposure auto */
    bool is_set;    /* --set tonemap.exposure is given */
    bool is_chosen; /* `stops` was metered */
    float stops;
};

/* Options that describe the scene. */
struct setup_scene {
    const char *name; /* SCENE; NULL if it is missing */
    const char *environment, *surroundings, *material;
    const char *cracks;                 /* crack model file; NULL: generated */
    const char *bump, *bump_mask, *air; /* image files; NULL: generated */
    struct material_override material_overrides[SETUP_NODE_COUNT];
    uint32_t material_override_count;
    struct object_transform object_transforms[SETUP_NODE_COUNT]; /* --transform and --hide */
    uint32_t object_transform_count;
    const char *animation; /* name or number of an animation, or "none"; NULL selects the first */
    struct model_transform model_transform;
    bool has_transform;             /* set by an option */
    bool has_default_environment;   /* `environment` is the asset's default */
    float env_rotate;               /* degrees */
    float env_exposure;             /* stops */
    bool no_background;             /* alpha 0 instead of a background */
    struct setup_vector background; /* linear */
    struct stage_params ground;     /* of --ground */
    struct stage_params stage;      /* chosen by setup_choose_stage() */
    bool is_stage_bare;             /* only one clear object stands on the stage */
    struct reader_params reader;
    const struct scene_source *source; /* data instead of files; NULL for none */
    struct loaded_files *files;        /* where to keep what files hold; NULL for nowhere */
    struct settings settings;
    struct settings user_settings; /* without those that the scene sets */
    struct setup_exposure exposure;
    const char *preset; /* file, or NULL */
    bool quiet;         /* print no notes */
    bool plain;         /* no inclusions, bumps and highlights */
};

/* Options that describe the rendered image of a scene. */
struct setup_image {
    struct setup_scene scene;
    const struct technique *refraction; /* bounce until setup_choose_refraction() */
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
    uint64_t layers;                /* bit i: techniques_layer(i) */
    const char *ocio;               /* CONFIG,VIEW for PNG files, or NULL */
    uint32_t png_bits;              /* bits per channel; 0 means 8 */
    const struct frame_layer *show; /* PNG layer; NULL: tone-mapped image */
    const char *camera;             /* name or number; NULL if unset */
    struct setup_position eye, target;
    struct setup_vector orbit; /* azimuth, elevation (degrees), distance (metres) */
    float fov_deg;             /* 0: default of the camera */
};

/* Names of the output files. */
struct setup_outputs {
    const char *paths[SETUP_OUTPUT_COUNT];
    uint32_t count;
};

/* Options of the interactive window. */
struct setup_window {
    uint32_t frame_count; /* frames to show; 0: no limit */
    double time_step;     /* scene seconds; 0: real time */
    const char *watch;    /* shader folder to watch, or NULL */
    VkPresentModeKHR present;
    enum setup_overlay overlay;
    float ui_scale;      /* panel scale; 0: the desktop's */
    uint32_t theme;      /* index into app_themes */
    const char *ui_dump; /* file of control positions, or NULL */
    const char *session; /* session file, or NULL */
};

/* Checks that SCENE is given. If not, logs and returns STATUS_USAGE. */
MUST_USE enum status setup_require_scene(const struct setup_scene *options);

struct bump_maps_params;

/* Returns scene parameters with pointers to `maps` and `options`, which must outlive them. */
struct scene_params setup_scene_params(const struct setup_scene *options,
                                       struct bump_maps_params *maps);

/* Loads the scene that the options name. Poses an animated model at the setting motion.time. Also
 * chooses settings that depend on the scene, such as refract.ior. */
MUST_USE enum status setup_load_scene(struct scene *scene, struct setup_scene *options);

struct asset;
/* Returns the default environment for a scene name, or NULL for the built-in sky. */
const struct asset *setup_default_environment(const char *name);

/* Returns the stage of --ground, or for --ground auto the one that suits the model. */
struct stage_params setup_stage(const struct setup_scene *options, const struct model *model);

/* Returns the name of a stage's ground as the value of --ground; writes a colour into `text`. */
const char *setup_ground_name(const struct stage_params *stage,
                              char text[static SETUP_GROUND_NAME_SIZE]);

/* Writes the value of --transform for an object, such as "cube=0,0.01,0". Returns false if the
 * transform moves nothing. */
bool setup_print_transform(const struct object_transform *transform,
                           char text[static SETUP_TRANSFORM_SIZE]);

/* Refuses --ground for built-in scenes: logs and returns STATUS_USAGE. */
MUST_USE enum status setup_check_ground(const struct setup_scene *options);

/* Returns true if an environment is the one that a stage brings for a scene by default. */
bool setup_is_stage_environment(const char *scene, const char *environment);

/* Chooses the stage of a model, and the stage's panorama unless the options set an environment. */
void setup_choose_stage(struct setup_scene *options, const struct scene *scene);

/* Sets the settings of the stage's key light. */
void setup_choose_stage_settings(struct setup_scene *options);

/* Writes a loaded scene's default settings to `options`. Settings given by the user are kept. */
void setup_apply_scene_settings(struct setup_scene *options, const struct scene *scene);

/* Returns a loaded scene's settings without changes by --set, --preset, --plain or the user. */
struct settings setup_scene_settings(const struct setup_scene *options, const struct scene *scene);

/* Logs a note for each pair of objects of different media that share faces, if neither states a
 * priority. */
void setup_note_contacts(const struct setup_scene *options, const struct scene *scene);

/* Begins to load a scene. After success, only a lack of memory can make setup_fill_scene() fail. */
MUST_USE enum status setup_begin_scene(struct scene *scene, struct setup_scene *options);
/* Does the slow part of loading. Meanwhile, other threads may read the scene. Returns NULL on
 * success. If out of memory, returns the name of the data that did not fit. */
MUST_USE const char *setup_fill_scene(struct scene *scene, const struct setup_scene *options);
/* Logs that memory ran out for `lacking`, named by setup_fill_scene(). Returns STATUS_TRY_AGAIN. */
enum status setup_log_fill_failure(const char *lacking);

/* Updates a scene after changes of its materials: see scene_update_materials(). */
MUST_USE enum status setup_update_materials(struct scene *scene, const struct setup_scene *options);

/* Poses an animated model at `time`, in seconds, by reloading and filling the scene. If the scene
 * is not animated or already has this pose, does nothing. On failure, the scene is unchanged. No
 * other code may use the scene meanwhile. */
MUST_USE enum status setup_pose_scene(struct scene *scene, const struct setup_scene *options,
                                      float time, bool *is_changed);

/* Chooses the refraction model of a loaded scene unless one is named: bounce for one closed
 * refractive object that it draws without approximation, seen from outside, else trace. Logs a note
 * if it is trace (unless quiet), and warnings of what the model leaves out that the reference
 * draws. `camera` is that of the first frame; NULL if it is outside all objects. */
void setup_choose_refraction(struct setup_image *image, const struct scene *scene,
                             const struct camera *camera);

/* Logs a warning if trace.traversal asks for ray queries that the device does not support. */
void setup_check_rays(const struct settings *settings, const struct gpu *gpu);

/* Meters the exposure for --exposure auto, and for a model file unless an exposure or a background
 * colour is stated, and sets tonemap.exposure to it. Does not meter again if an exposure was
 * metered. `scene` must be at time 0, so that all frames have the same exposure. */
MUST_USE enum status setup_choose_exposure(struct setup_image *image, const struct scene *scene,
                                           const struct camera *camera);

/* Sets tonemap.exposure to the metered exposure, if any, as a value of the scene. */
void setup_put_exposure(struct setup_scene *options);

/* Loads the scene like setup_load_scene(), meters the exposure, and chooses the camera. */
MUST_USE enum status setup_load_exposed(struct scene *scene, struct camera *camera,
                                        struct setup_image *image);

/* Finds the camera that the options or the model set, else makes one that frames the object. */
MUST_USE enum status setup_camera(struct camera *camera, const struct scene *scene,
                                  const struct setup_image *p);

struct renderer_params;

/* Returns renderer parameters that point into `image`. The caller must add the sample count and the
 * outputs. */
struct renderer_params setup_renderer_params(const struct setup_image *p, struct gpu *gpu,
                                             const struct scene *scene);

#endif
