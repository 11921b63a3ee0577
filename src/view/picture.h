/*
 * picture.h: what the window shows: its state, scene, camera and the renderer for them; where it is
 * split, two renderers of the same scene. The command line only begins the state: panels, keys and
 * dropped files change it.
 *
 * A change makes anew only what it needs: nothing (the settings of shaders), what is other in the
 * renderer's plan (another list of techniques, another size), or the scene.
 *
 * Errors: logged once where found; a picture that cannot be made or changed leaves what was there.
 */
#ifndef FIRN_VIEW_PICTURE_H
#define FIRN_VIEW_PICTURE_H

#include "src/app/app.h"
#include "src/render/renderer.h"
#include "src/render/uploaded_scene.h"
#include "src/view/quick.h"

/* A scene, and that on the device. */
struct picture_scene {
    struct scene scene;
    struct uploaded_scene uploaded;
};

struct picture {
    struct gpu *gpu;
    bool quiet;               /* files are written without a line about them */
    struct app_picture state; /* its size is that of the renderer; settings in use */
    char *scene_name;         /* of the state; own */
    char *environment_name;   /* the same; may be NULL */
    struct scene scene;
    struct uploaded_scene uploaded;
    struct watch *watch;        /* may be NULL */
    struct camera camera;       /* where a hand has put it */
    struct camera first_camera; /* where it was */
    struct renderer *renderer;  /* NULL until picture_resize() */
    struct renderer *right;     /* of state.split; NULL without */
    struct quick quick;         /* for movements */
    bool shows_quick;           /* picture_left() and picture_right() are those of `quick` */
    bool has_right_settings;    /* else they are those on the left: */
    struct settings right_settings;
    struct picture_scene *right_scene; /* that those shape; NULL: the one on the left */
    bool shows_still;                  /* on the right, instead of a renderer's picture: */
    VkImage still;                     /* NULL: nothing yet, so the left is shown there, too */
    VkExtent2D still_extent;           /* pixels */
    bool flipped;     /* the right is shown in place of the left, without a divider */
    double divider;   /* between them: of the width, from the left */
    bool refines;     /* renderers can do what picture_refine() needs */
    VkImage instead;  /* of the whole size, shown in place of all; NULL: nothing */
    bool shows_mean;  /* picture_left() and picture_right() are means of samples */
    VkExtent2D view;  /* of what they show, pixels */
    bool is_wide;     /* renderer_is_wide() of one of the renderers */
    uint64_t version; /* another one whenever the renderers are */
};

/* Loads the scene; the strings of the state are copied or outlive the picture, as do the watched
 * shaders (may be NULL). */
struct watch;
MUST_USE enum status picture_create(struct picture **picture, struct gpu *gpu,
                                    const struct app_picture *state, struct watch *watch,
                                    bool quiet, bool refines);
void picture_destroy(struct picture *picture); /* may be NULL; waits for its frames */

/* Frees all that it has on the device, and brings the scene onto another, opened in the same gpu.
 * Between both, and if that fails, it may only be destroyed or given another try. */
void picture_leave_device(struct picture *picture); /* may be NULL */
MUST_USE enum status picture_upload(struct picture *picture);

/* Changes the renderers to this size, or makes them. On failure there are none. */
MUST_USE enum status picture_resize(struct picture *picture, VkExtent2D size);

/*
 * Takes other settings, in a scene that is else the state's, and another rung. *remade: the
 * renderer is another one, and so is renderer_picture(). A new scene keeps the camera.
 */
MUST_USE enum status picture_change(struct picture **picture, const struct app_scene *scene,
                                    const struct technique *rung, bool *remade);

/*
 * Another object (a model file) or, by its ending (.exr, .hdr) or its name (sky, or that of an
 * asset), another environment. If that fails *picture stays; else it is another one, of the same
 * size, and *remade. An environment keeps the camera. What the object before has brought with it,
 * settings and an environment, goes with it, unless a hand has set another value.
 */
MUST_USE enum status picture_load(struct picture **picture, const char *path, bool *remade);

/* All that a state says, in the size of now and with its own camera. On failure *picture stays. */
MUST_USE enum status picture_use(struct picture **picture, const struct app_picture *state);

/* `settings` with the exposure of others, which needs no new samples. */
struct settings picture_with_exposure(const struct settings *settings, const struct settings *of);

/* Shows another rung on the right; NULL: none. `settings`: those it has, copied; NULL: those on the
 * left. On failure it stays as it was. */
MUST_USE enum status picture_split(struct picture *picture, const struct technique *rung,
                                   const struct settings *settings);

bool picture_is_split(const struct picture *picture); /* something is shown on the right */

/* Turns the panorama around the scene, degrees. On failure it stays as it was. */
MUST_USE enum status picture_turn(struct picture *picture, float degrees);

/* Returns whether the camera has moved to where the renderers of its picture are different ones
 * (renderer_is_wide()). */
bool picture_is_outgrown(struct picture *picture);

/* Changes the renderers, if there are any: the watched shaders are others, the projection, or what
 * picture_is_outgrown() says. On failure there are none: picture_resize() makes them. */
MUST_USE enum status picture_remake(struct picture *picture);

/* Returns whether an animated model has the pose of a time, seconds; true of others. */
bool picture_is_posed(const struct picture *picture, float time);

/* Poses an animated model for a time, and frees the renderers: picture_resize() makes others. If
 * the file cannot be read, all stays. The camera follows that of the file, unless it was moved. */
MUST_USE enum status picture_pose(struct picture *picture, float time);

/* What of renderer.h the window needs, for one renderer or two. */
MUST_USE enum status picture_draw(struct picture *picture, const struct renderer_shot *shot);
MUST_USE enum status picture_wait(struct picture *picture);

/* Draws one that moves, in a size up to its own: by what is quick, if there is such a thing. */
MUST_USE enum status picture_draw_part(struct picture *picture, const struct renderer_shot *shot,
                                       VkExtent2D view);

/* Whether that is still to be made, and makes it: quick_make(). */
bool picture_wants_quick(const struct picture *picture);
MUST_USE enum status picture_make_quick(struct picture *picture, const struct renderer_shot *shot);

/* What renderer.h has for renderers that refine. */
MUST_USE enum status picture_refine(struct picture *picture, const struct renderer_shot *shot,
                                    uint32_t sample);
MUST_USE enum status picture_resolve(struct picture *picture, uint32_t sample_count);

/* The renderers of what is shown; right: NULL without one. */
const struct renderer *picture_renderer(const struct picture *picture, bool right);

double picture_passes(const struct picture *picture); /* of the last frame that ended, seconds */
VkImage picture_left(const struct picture *picture);
VkImage picture_right(const struct picture *picture);           /* unless split, the same */
VkExtent2D picture_extent(const struct picture *picture);       /* of the left, pixels */
VkExtent2D picture_right_extent(const struct picture *picture); /* of the right */

/* The column where the line between left and right begins; PRESENT_NO_LINE: not split. */
uint32_t picture_line(const struct picture *picture);

/* Metres between which the camera may stand off its target. */
void picture_range(const struct picture *picture, float *nearest, float *farthest);

/*
 * Draws the picture as `firn render` does, with all samples and layers of the state, and
 * writes it with the same words in it, each to a file that its ending names. Of a split picture a
 * PNG file shows what the window shows, and NAME.exr becomes NAME-left.exr and NAME-right.exr.
 */
struct signals;
MUST_USE enum status picture_write(struct picture *picture, float time, const char *const *paths,
                                   uint32_t path_count, struct signals *stop);

/* Writes what was drawn of it (`rgba` of this size, one sample) to a PNG file, with the same words
 * in it. */
MUST_USE enum status picture_write_drawn(struct picture *picture, float time, const char *path,
                                         const struct render_result *drawn, VkExtent2D size,
                                         struct signals *stop);

/* Whether a picture that is split (or not) can be written to them. Logs: STATUS_USAGE. */
MUST_USE enum status picture_can_write(bool is_split, const char *const *paths,
                                       uint32_t path_count);

/* For renderers of the picture as it is, and of what is on the right of it. */
struct renderer_params picture_params(struct picture *picture);
struct renderer_params picture_right_params(struct picture *picture);

#endif
