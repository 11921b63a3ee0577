/*
 * view_renderers.h: the viewport: scene, camera, settings and renderers of the displayed image.
 * With a split view there are two renderers of one scene. Command-line options give only the
 * initial state; panels, keys and dropped files change it.
 *
 * A change rebuilds as little as possible: nothing for shader settings, the affected part of the
 * renderer's plan for another set of techniques or another size, or the scene.
 *
 * Errors: logged once where found; a viewport that cannot be changed keeps its previous state.
 */
#ifndef FIRN_VIEW_VIEW_RENDERERS_H
#define FIRN_VIEW_VIEW_RENDERERS_H

#include "src/render/renderer.h"
#include "src/render/uploaded_scene.h"
#include "src/setup/setup.h"
#include "src/view/draft_renderer.h"

/* A scene and its GPU resources. */
struct viewport_scene {
    struct scene scene;
    struct uploaded_scene uploaded;
};

struct viewport {
    struct gpu *gpu;
    bool quiet;               /* print nothing about written files */
    struct setup_image state; /* current options and renderer size */
    char *scene_name;         /* string of `state`, owned */
    char *environment_name;   /* string of `state`, owned, or NULL */
    char *material_name;      /* string of `state`, owned, or NULL */
    struct scene scene;
    struct uploaded_scene uploaded;
    struct shader_reload *shader_reload; /* shader hot reload; may be NULL */
    struct camera camera;
    struct camera first_camera;      /* camera before the user moved it */
    struct renderer *renderer;       /* NULL until viewport_resize() */
    struct renderer *right_renderer; /* renderer of side B, or NULL */
    struct draft_renderer draft;     /* draft renderers for interaction */
    bool shows_draft;                /* displayed images come from `draft` */
    bool has_right_settings;         /* side B uses right_settings */
    struct settings right_settings;
    struct viewport_scene *side_b_scene; /* NULL if side B uses `scene` */
    bool shows_comparison_image;         /* side B is `comparison_image` */
    VkImage comparison_image;            /* NULL until available */
    VkExtent2D comparison_extent;        /* pixels */
    bool flipped;                        /* only side B is shown */
    double divider;                      /* divider position, fraction of the width */
    bool is_progressive;                 /* renderers support viewport_refine() */
    VkImage replacement;                 /* image displayed instead, or NULL */
    bool shows_mean;                     /* displayed images are sample means */
    bool is_left_refined;                /* side A has finished the sample, side B not */
    VkExtent2D extent;
    bool draws_beyond_image; /* renderer_draws_beyond_image() of either renderer */
    uint64_t version;        /* changes whenever the renderers are replaced */
};

struct shader_reload;
/* Creates a viewport and loads the scene. Borrows `reload` and the strings of `state`. */
MUST_USE enum status viewport_create(struct viewport **viewport, struct gpu *gpu,
                                     const struct setup_image *state, struct shader_reload *reload,
                                     bool quiet, bool refines);
void viewport_destroy(struct viewport *p); /* may be NULL; waits for frames */

/* Frees all device resources. When the device is reopened, call viewport_upload(). Until that
 * succeeds, only viewport_upload() and viewport_destroy() are allowed. */
void viewport_leave_device(struct viewport *p); /* may be NULL */
MUST_USE enum status viewport_upload(struct viewport *p);

/* Creates the renderers, or resizes them. On failure, there are no renderers. */
MUST_USE enum status viewport_resize(struct viewport *p, VkExtent2D size);

/* Applies settings and refraction model; keeps the camera. If the renderer was replaced, sets
 * *remade to true; images from renderer_display_image() are then invalid. */
MUST_USE enum status viewport_change(struct viewport **viewport, const struct setup_scene *scene,
                                     const struct technique *refraction, bool *remade);

/* Loads the scene again with other options. Its settings become those of the user, completed by the
 * scene. Keeps the camera. */
MUST_USE enum status viewport_reload(struct viewport **viewport, const struct setup_scene *scene);

/* Opens a model file or, by its extension (.exr, .hdr) or name (sky, or an asset), an environment.
 * On success *viewport is replaced by one of the same size and *remade is true; on failure it
 * stays. An environment keeps the camera. Settings and environment that the previous object brought
 * are dropped, unless the user has changed them. */
MUST_USE enum status viewport_load(struct viewport **viewport, const char *path, bool *remade);

/* Applies a whole state, including the camera, at the current size. On failure, nothing changes. */
MUST_USE enum status viewport_apply_state(struct viewport **viewport,
                                          const struct setup_image *state);

/* Returns a copy of `settings` with the exposure replaced by that of `of`. */
struct settings viewport_with_exposure(const struct settings *settings, const struct settings *of);

/* Shows a refraction model as side B. NULL ends the split. Copies `settings`. If `settings` is
 * NULL, side B uses the settings of side A. On failure, nothing changes. */
MUST_USE enum status viewport_split(struct viewport *p, const struct technique *refraction,
                                    const struct settings *settings);

bool viewport_is_split(const struct viewport *p); /* true if side B is shown */

/* Rotates the environment panorama, degrees. On failure nothing changes. */
MUST_USE enum status viewport_rotate_panorama(struct viewport *p, float degrees);

/* Returns true if the camera has moved in such a way that viewport_rebuild() is required. */
bool viewport_is_outgrown(struct viewport *p);

/* Updates the renderers. Call this after a change of shaders or projection, and if
 * viewport_is_outgrown(). On failure, frees them; viewport_resize() creates new renderers. */
MUST_USE enum status viewport_rebuild(struct viewport *p);

/* Returns true if the model is not animated or has the pose of `time`, seconds. */
bool viewport_is_posed(const struct viewport *p, float time);

/* Poses an animated model and frees the renderers; call viewport_resize() next. If the file cannot
 * be read, nothing changes. The file's camera animation applies until the user moves the camera. */
MUST_USE enum status viewport_pose(struct viewport *p, float time);

/* Draws a frame with the renderers of both sides. */
MUST_USE enum status viewport_draw(struct viewport *p, const struct renderer_shot *shot);
/* Draws an image that is not shown, which compiles the shaders. */
MUST_USE enum status viewport_warm_up(struct viewport *p, const struct renderer_shot *shot);
MUST_USE enum status viewport_wait(struct viewport *p); /* waits for both sides */

/* Draws an interactive frame of at most full size, with draft renderers if there are any. */
MUST_USE enum status viewport_draw_interactive(struct viewport *p, const struct renderer_shot *shot,
                                               VkExtent2D view);

/* Returns true if draft renderers are needed but missing. viewport_create_draft() creates them. */
bool viewport_wants_draft(const struct viewport *p);
MUST_USE enum status viewport_create_draft(struct viewport *p, const struct renderer_shot *shot);

/* Draws the next part of a sample of both sides, as renderer_refine() does for one. */
MUST_USE enum status viewport_refine(struct viewport *p, const struct renderer_shot *shot,
                                     uint32_t sample, double seconds, bool *is_done);
MUST_USE enum status viewport_abandon(struct viewport *p); /* drops the sample of both sides */
/* Does a step of renderer_resolve() for both sides. */
MUST_USE enum status viewport_resolve(struct viewport *p, uint32_t sample_count, uint32_t step);

/* Returns the renderer of the left or right image. Without a split, the right one is NULL. */
const struct renderer *viewport_renderer(const struct viewport *p, bool right);

/* Returns the GPU time of the last frame's passes, in seconds. */
double viewport_pass_seconds(const struct viewport *p);
VkImage viewport_left(const struct viewport *p);
VkImage viewport_right(const struct viewport *p);           /* as on the left unless split */
VkExtent2D viewport_extent(const struct viewport *p);       /* size of the left image, pixels */
VkExtent2D viewport_right_extent(const struct viewport *p); /* size of the right image */

/* Returns the pixel column where the divider begins; PRESENT_NO_LINE without a split. */
uint32_t viewport_divider_column(const struct viewport *p);

/* Returns the allowed range of the camera's distance from its target, metres. */
void viewport_camera_range(const struct viewport *p, float *nearest, float *farthest);

struct signals;
/* Renders the image like `firn render`, with all samples and layers, and writes it to each path.
 * The extension of a path selects the format. If the view is split, a PNG file shows both sides
 * with the divider. Each side gets its own EXR file, NAME-left.exr and NAME-right.exr. */
MUST_USE enum status viewport_save(struct viewport *p, float time, const char *const *paths,
                                   uint32_t path_count, struct signals *stop);

/* Logs and returns STATUS_USAGE if a split view cannot be saved to one of the paths. */
MUST_USE enum status viewport_can_save(bool is_split, const char *const *paths,
                                       uint32_t path_count);

/* Returns the parameters for the renderer of side A. */
struct renderer_params viewport_params(struct viewport *p);
struct renderer_params viewport_right_params(struct viewport *p); /* of side B */

#endif
