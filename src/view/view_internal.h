/* view_internal.h: state of the viewer and functions shared by its files. */
#ifndef FIRN_VIEW_VIEW_INTERNAL_H
#define FIRN_VIEW_VIEW_INTERNAL_H

#include <pthread.h>
#include "src/base/signals.h"
#include "src/scene/cache/loaded_files.h"
#include "src/view/compare/view_compare.h"
#include "src/view/panels/ui.h"
#include "src/view/pixel_inspector.h"
#include "src/view/session/session_file.h"
#include "src/view/session/undo_scenes.h"
#include "src/view/session/undo_stack.h"
#include "src/view/view_frame_stats.h"
#include "src/view/view_progressive.h"
#include "src/view/view_renderers.h"
#include "src/view/viewer.h"
#include "src/view/window/presenter.h"
#include "src/view/window/window.h"

#define VIEW_HOLD 0x80000000u /* gesture-number bit that marks a drag of the light */

enum {
    VIEW_BOOKMARK_COUNT = 4,
};

struct view {
    const struct viewer_params *options;
    struct setup_image initial_state; /* from the options */
    struct session_file session;      /* from --session; .scene NULL once restored */
    struct loaded_files files;        /* files of the scene that is shown */
    struct signals signals;
    FILE *original_stderr; /* NULL while errors are not captured */
    pthread_mutex_t error_lock;
    char error[512]; /* last logged error, protected by the lock; or "" */
    struct window window;
    struct gpu_window_system system;
    struct gpu gpu;
    VkSurfaceKHR surface;
    struct presenter presenter;
    struct viewport *viewport;
    struct shader_reload *shader_reload; /* NULL without --watch */
    struct ui *ui;
    struct ui_thumbnails thumbnails; /* thumbnails for `ui` */
    float ui_scale;                  /* scale of text and panels; 0 if not known yet */
    uint32_t theme;                  /* index for theme_at() */
    char busy[200];                  /* what is being loaded, or "" */
    struct window_layout layout;
    struct present_area image_area; /* image position in the last frame */
    VkExtent2D requested_size;      /* image size after the next resize */
    double resize_at; /* clock_seconds() at which the renderer is resized; 0 if not needed */
    struct undo_stack undo_stack;
    struct undo_scene *undo_scenes; /* scenes that undo can return to */
    uint32_t scene, scene_count;    /* current number; number opened */
    bool has_orbited;               /* the user orbited the camera */
    uint32_t press_count;           /* number of mouse button presses */
    double now;                     /* time of this iteration, seconds */
    double elapsed;                 /* scene time since motion.time, seconds */
    float drawn_time;               /* scene time last drawn, seconds */
    bool paused, changed, quit;
    double recovered_at;        /* time at which a lost device was reopened, seconds; or 0 */
    uint32_t message_count;     /* validation messages of a lost device */
    bool redrawn;               /* the last frame changed the image */
    VkExtent2D initial_size;    /* window size at startup, pixels */
    bool wants_screenshot;      /* save the next frame to files */
    VkExtent2D screenshot_size; /* 0x0 for the window's size */
    bool recenters;             /* centre the camera on the surface at (recenter_x, recenter_y) */
    double recenter_x, recenter_y; /* position in the window, pixels */
    bool screenshot_to_clipboard;  /* copy instead of saving */
    uint32_t screenshot_number;    /* number of the last screenshot */
    struct view_frame_stats frame_stats;
    struct view_progressive progressive;
    struct view_compare compare;
    bool had_inspector_panel; /* the panel was open before */
    struct pixel_inspector inspector;
    struct pixel_inspector_choice inspector_choice; /* chosen, but not applied yet */
    struct camera bookmarks[VIEW_BOOKMARK_COUNT];
    uint32_t bookmark_count; /* number stored; the oldest is replaced when all are in use */
    struct scene_objects objects;
    uint32_t selected;                      /* index in `objects`; SCENE_OBJECT_NONE for none */
    char selected_name[MATERIAL_NAME_SIZE]; /* or "" */
    struct object_outline outline;          /* of the selected object */
    char scene_change[96]; /* how the scene differs from the one before; "" for another file */
    struct view_identity inspector_identity; /* view for which `inspector.layers` was rendered */
};

float view_time(const struct view *view);      /* scene time, seconds */
void view_seek(struct view *view, float time); /* sets the scene time, seconds */
/* Sets the window title, and the text beside the spinner, to what is being loaded. */
void view_set_title(struct view *view, const char *what);
void view_show_name(struct view *view);

/* Captures errors written to stderr, which are still printed, for view_fail(). All threads may log
 * until view_release_errors(). */
void view_capture_errors(struct view *view);
void view_release_errors(struct view *view);
void view_clear_errors(struct view *view); /* forgets the last logged error */
/* Shows `what` and the last logged error, if there is one, in the status bar. */
void view_fail(struct view *view, const char *what);
void view_show_ui(struct view *view, bool shown);
void view_update_layout(struct view *view, VkExtent2D size); /* `size` of the window, pixels */

/* ---- view_actions.c: actions ---- */

void view_execute(struct view *view, enum view_action action);
void view_use_camera(struct view *view, const struct camera *camera);

/* Returns the index of the bookmark that the camera is at; UINT32_MAX if it is at none. */
uint32_t view_bookmark(const struct view *view);
void view_zoom(struct view *view, float steps);
void view_move_divider(struct view *view, double to); /* `to`: fraction of the image width */

/* ---- view_edit.c: changes with undo ---- */

struct view_state view_state_now(const struct view *view);

/* Records that another scene was opened, so that undo can return to the state `before`. */
void view_enter_scene(struct view *view, const struct view_state *before);

/* Returns the settings of the scene without changes by the user. */
struct settings view_scene_settings(const struct view *view);

/* Applies a state. On failure, reports it, keeps the previous state and returns false. */
bool view_apply_state(struct view *view, const struct view_state *state);

/* Applies a state and pushes it to the undo stack. Returns false on failure. */
bool view_edit(struct view *view, const struct view_state *requested, uint32_t gesture);
void view_undo_redo(struct view *view, bool again); /* undo, or redo if `again` */

/* Loads settings from a preset file. */
void view_load_preset(struct view *view, const char *path);
void view_save_preset(struct view *view); /* to a new file */

typedef void view_print_fn(const struct view *view, FILE *out);

/* Saves what `print` prints as a new file in the user's folder of presets or sessions, and shows
 * its path. `what` is "preset" or "session". `omitted` names what the file lacks, or is NULL. */
void view_save_text(struct view *view, const char *what, const char *extension,
                    view_print_fn *print, const char *omitted);

/* Opens a model, environment, preset, session or image. The kind of file is detected. */
void view_open(struct view *view, const char *path);

/* ---- view_compare.c: A/B comparison ---- */

/* Sets side B of `state`. If no state is stored, VIEW_SIDE_B_STATE acts as VIEW_SIDE_B_MODEL. */
void view_compare_choose(struct view *view, struct view_state *state, enum view_side_b other);

/* Shows side B of a state. On failure, logs an error and changes nothing. */
MUST_USE enum status view_compare_use(struct view *view, const struct view_state *state);

/* Stops the reference job. Must be called before the scene or the settings change. */
void view_compare_stop(struct view *view);

void view_compare_with(struct view *view, enum view_side_b other);
void view_compare_toggle(struct view *view); /* turns the comparison on or off */
void view_compare_store(struct view *view);  /* stores side A as side B */
void view_compare_flip(struct view *view);   /* toggles between sides A and B */
void view_compare_toggle_error_map(struct view *view);

/* Makes side B show the next image file that is dropped onto the window. */
void view_compare_await(struct view *view);
bool view_compare_accepts(const struct view *view, const char *path);
void view_compare_open(struct view *view, const char *path); /* opens side B */

/* Starts and stops the comparison's worker jobs, takes their results and reports failures. */
void view_compare_follow(struct view *view);

/* Shows new results of the comparison's jobs in the viewport. */
MUST_USE enum status view_compare_show(struct view *view);

/* Writes labels for the left and right sides. Without a comparison, `right` is set to "". */
void view_compare_print(const struct view *view, char left[static VIEW_SIDE_SIZE],
                        char right[static VIEW_SIDE_SIZE]);

/* ---- view_mouse_input.c: input ---- */

/* Handles all input since the last call. */
void view_handle_input(struct view *view);

/* Runs the panels if they are shown, and does what the user chose in them. */
void view_run_ui(struct view *view, VkExtent2D size);

/* ---- view_light_drag.c: light ---- */

/* Rotates the lighting about the vertical axis. If `is_sun`, moves only the sun, also up and down.
 * `right`, `down`: mouse movement in window heights. If the light cannot move, shows why. */
void view_rotate_light(struct view *view, double right, double down, bool is_sun);

void view_add_exposure(struct view *view, double stops); /* adds stops to the exposure */

/* ---- view_session.c: sessions ---- */

/* Reads a session file. Logs errors. */
MUST_USE enum status view_read_session(struct session_file *session, const char *path,
                                       const struct reader_params *reader);

/* Loads the scene's file again with one material for all of its nodes, as --material does. */
void view_replace_materials(struct view *view, const struct material_choice *choice);

/* Loads the scene again with other options for its materials or objects. `words` say what changed.
 * `scene` must not be that of the viewport. */
void view_reload_scene(struct view *view, const struct setup_scene *scene, const char *words);

/* ---- view_objects.c: selected object ---- */

/* Brings the list of objects, the selection and its outline up to date. */
void view_update_objects(struct view *view);
void view_select(struct view *view, uint32_t index);

/* Selects the object at a point of the image, in fractions of its width and height. */
void view_pick(struct view *view, float x, float y);

/* Sets the distance of the focus to that of the surface at a point of the image. */
void view_focus(struct view *view, float x, float y);

/* Gives a node a material, as --material NODE=NAME does; can be undone. */
void view_override_material(struct view *view, const struct material_override *override);

/* Transforms, hides or shows a node, as --transform and --hide do; can be undone. */
void view_transform_object(struct view *view, const struct object_transform *transform);

/* Copies a session's scene, settings and refraction model to `state`, which borrows the strings.
 * The caller shows `state`; then view_resume_session() restores camera, time and side B. */
void view_apply_session(const struct session_file *session, struct setup_image *state);
MUST_USE enum status view_resume_session(struct view *view, const struct session_file *session);

void view_load_session(struct view *view, const char *path);
void view_save_session(struct view *view);

/* ---- view_progressive.c: progressive refinement ---- */

/* Creates draft renderers if they are needed. Call after drawing the first image. */
MUST_USE enum status view_progressive_begin(struct view *view);

/* If the view has changed, draws it at the reduced size for interaction. */
MUST_USE enum status view_progressive_draw(struct view *view, const struct renderer_shot *shot);

/* If the view is at rest, prepares or draws the next sample. *drew is false if nothing was done. */
MUST_USE enum status view_progressive_step(struct view *view, bool *drew);

/* Stops drawing samples until the view changes or this is called again. */
void view_progressive_stop(struct view *view);

/* Returns true if samples are drawn, but none is shown yet. */
bool view_progressive_is_first(const struct view *view);

/* Returns the seconds until the next sample may be drawn. Negative if no samples remain. */
double view_progressive_wait(const struct view *view);

/* Estimates the seconds until all samples are drawn; 0 if done or unknown. */
double view_progressive_seconds_left(const struct view *view);

/* Returns true if two views are equal except for the exposure. */
bool view_progressive_is_same(const struct view_identity *a, const struct view_identity *b);

/* ---- view_inspect.c: pixel inspector ---- */

/* Renders and shows the inspected layer once the view is at rest. Reports failures. */
void view_inspect(struct view *view);

/* ---- view_screenshot.c: screenshots ---- */

/* Saves the image or copies it to the clipboard, as requested. Failures are only logged. */
void view_take_screenshot(struct view *view);

/* Writes the files of --screenshot at exit. */
MUST_USE enum status view_write_outputs(struct view *view);

#endif
