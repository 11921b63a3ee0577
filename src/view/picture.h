/*
 * picture.h: the viewport: scene, camera, settings and renderers of the displayed image. With a
 * split view there are two renderers of one scene. Command-line options give only the initial
 * state; panels, keys and dropped files change it.
 *
 * A change rebuilds as little as possible: nothing for shader settings, the affected part of the
 * renderer's plan for another set of techniques or another size, or the scene.
 *
 * Errors: logged once where found; a viewport that cannot be changed keeps its previous state.
 */
#ifndef FIRN_VIEW_PICTURE_H
#define FIRN_VIEW_PICTURE_H

#include "src/app/app.h"
#include "src/render/renderer.h"
#include "src/render/uploaded_scene.h"
#include "src/view/quick.h"

/* A scene and its GPU resources. */
struct picture_scene {
    struct scene scene;
    struct uploaded_scene uploaded;
};

struct picture {
    struct gpu *gpu;
    bool quiet;               /* write files without printing a line about them */
    struct app_picture state; /* current options; its size is that of the renderer */
    char *scene_name;         /* string of `state`, owned */
    char *environment_name;   /* string of `state`, owned; may be NULL */
    struct scene scene;
    struct uploaded_scene uploaded;
    struct watch *watch;        /* shader hot reload; may be NULL */
    struct camera camera;       /* current camera, as moved by the user */
    struct camera first_camera; /* camera before the user moved it */
    struct renderer *renderer;  /* NULL until picture_resize() */
    struct renderer *right;     /* renderer of state.split (side B); NULL without a split */
    struct quick quick;         /* draft renderers for interaction */
    bool shows_quick;           /* picture_left() and picture_right() return images of `quick` */
    bool has_right_settings;    /* side B uses right_settings */
    struct settings right_settings;
    struct picture_scene *right_scene; /* scene of side B; NULL if that is `scene` */
    bool shows_still;                  /* side B is the fixed image `still` */
    VkImage still;           /* NULL if not available yet; side A is then shown on both sides */
    VkExtent2D still_extent; /* pixels */
    bool flipped;            /* side B is shown in place of side A, without a divider */
    double divider;          /* position of the divider, as a fraction of the width from the left */
    bool refines;            /* renderers support picture_refine() */
    VkImage instead;  /* full-size image displayed instead of everything else; NULL if none */
    bool shows_mean;  /* picture_left() and picture_right() are means of samples */
    VkExtent2D view;  /* size of these images, pixels */
    bool is_wide;     /* renderer_is_wide() of either renderer */
    uint64_t version; /* changes whenever the renderers are replaced */
};

struct watch;
/* Creates a viewport and loads its scene. Strings of `state` that are not copied, and `watch`, must
 * outlive it. */
MUST_USE enum status picture_create(struct picture **picture, struct gpu *gpu,
                                    const struct app_picture *state, struct watch *watch,
                                    bool quiet, bool refines);
void picture_destroy(struct picture *picture); /* may be NULL; waits for its frames */

/* Frees everything on the device; picture_upload() then uploads the scene to another device that
 * was opened in the same gpu. Between the calls, or after a failed upload, only destroying and
 * picture_upload() are allowed. */
void picture_leave_device(struct picture *picture); /* may be NULL */
MUST_USE enum status picture_upload(struct picture *picture);

/* Creates the renderers or changes them to this size. On failure there are none. */
MUST_USE enum status picture_resize(struct picture *picture, VkExtent2D size);

/*
 * Applies other settings (in an otherwise unchanged scene) and another refraction model. *remade is
 * true if the renderer, and so renderer_picture(), was replaced. A reloaded scene keeps the camera.
 */
MUST_USE enum status picture_change(struct picture **picture, const struct app_scene *scene,
                                    const struct technique *rung, bool *remade);

/*
 * Opens a model file or, by its extension (.exr, .hdr) or name (sky, or an asset), an environment.
 * On success *picture is replaced by one of the same size and *remade is true; on failure it stays.
 * An environment keeps the camera. Settings and environment that the previous object brought are
 * dropped, unless the user has changed them.
 */
MUST_USE enum status picture_load(struct picture **picture, const char *path, bool *remade);

/* Applies a whole state with its camera at the current size. On failure *picture stays. */
MUST_USE enum status picture_use(struct picture **picture, const struct app_picture *state);

/* Returns `settings` with the exposure of `of`; a change of exposure needs no new samples. */
struct settings picture_with_exposure(const struct settings *settings, const struct settings *of);

/* Shows another refraction model on the right (side B); NULL ends the split. `settings` of side B
 * are copied; NULL to use those of side A. On failure nothing changes. */
MUST_USE enum status picture_split(struct picture *picture, const struct technique *rung,
                                   const struct settings *settings);

bool picture_is_split(const struct picture *picture); /* true if side B is shown */

/* Rotates the environment panorama, degrees. On failure nothing changes. */
MUST_USE enum status picture_turn(struct picture *picture, float degrees);

/* Returns true if the camera has moved so far that other renderers are needed; renderer_is_wide().
 */
bool picture_is_outgrown(struct picture *picture);

/* Updates existing renderers after a change of watched shaders, of the projection, or if
 * picture_is_outgrown(). On failure there are none; picture_resize() creates them. */
MUST_USE enum status picture_remake(struct picture *picture);

/* Returns true if an animated model has the pose of this time, seconds, or if nothing is animated.
 */
bool picture_is_posed(const struct picture *picture, float time);

/* Poses an animated model for a time and frees the renderers; picture_resize() creates new ones. If
 * the file cannot be read, nothing changes. The camera follows the file's unless the user moved it.
 */
MUST_USE enum status picture_pose(struct picture *picture, float time);

/* Calls renderer_draw() or renderer_wait() for the renderers of both sides. */
MUST_USE enum status picture_draw(struct picture *picture, const struct renderer_shot *shot);
MUST_USE enum status picture_wait(struct picture *picture);

/* Draws a frame during interaction, at up to full size, with draft renderers if there are any. */
MUST_USE enum status picture_draw_part(struct picture *picture, const struct renderer_shot *shot,
                                       VkExtent2D view);

/* Returns true if draft renderers are missing but needed; picture_make_quick() creates them. */
bool picture_wants_quick(const struct picture *picture);
MUST_USE enum status picture_make_quick(struct picture *picture, const struct renderer_shot *shot);

/* Call renderer_refine() or renderer_resolve() for the renderers of both sides. */
MUST_USE enum status picture_refine(struct picture *picture, const struct renderer_shot *shot,
                                    uint32_t sample);
MUST_USE enum status picture_resolve(struct picture *picture, uint32_t sample_count);

/* Returns the renderer of the displayed image on one side; NULL for `right` without a split. */
const struct renderer *picture_renderer(const struct picture *picture, bool right);

/* GPU time of the last frame's passes, seconds */
double picture_passes(const struct picture *picture);
VkImage picture_left(const struct picture *picture);
VkImage picture_right(const struct picture *picture);           /* as on the left unless split */
VkExtent2D picture_extent(const struct picture *picture);       /* size of the left image, pixels */
VkExtent2D picture_right_extent(const struct picture *picture); /* size of the right image */

/* Returns the first column of the divider, or PRESENT_NO_LINE if not split. */
uint32_t picture_line(const struct picture *picture);

/* Returns the allowed range of the camera's distance from its target, metres. */
void picture_range(const struct picture *picture, float *nearest, float *farthest);

struct signals;
/*
 * Renders the image as `firn render` does, with all samples and layers of the state, and writes it
 * to each path with firn's metadata; the extension selects the format. Of a split view, a PNG
 * file shows both sides with the divider, and NAME.exr becomes NAME-left.exr and NAME-right.exr.
 */
MUST_USE enum status picture_write(struct picture *picture, float time, const char *const *paths,
                                   uint32_t path_count, struct signals *stop);

/* Writes pixels that were already drawn (`rgba` of this size, one sample) to a PNG file, with
 * firn's metadata. */
MUST_USE enum status picture_write_drawn(struct picture *picture, float time, const char *path,
                                         const struct render_result *drawn, VkExtent2D size,
                                         struct signals *stop);

/* Returns STATUS_USAGE, logged, if a path cannot take the two sides of a split view. */
MUST_USE enum status picture_can_write(bool is_split, const char *const *paths,
                                       uint32_t path_count);

/* Return parameters for renderers of side A and side B. */
struct renderer_params picture_params(struct picture *picture);
struct renderer_params picture_right_params(struct picture *picture);

#endif
