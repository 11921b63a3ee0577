/* view_internal.h: state of the viewer and functions shared by its files. */
#ifndef FIRN_VIEW_VIEW_INTERNAL_H
#define FIRN_VIEW_VIEW_INTERNAL_H

#include "src/app/signals.h"
#include "src/view/pixel_inspector.h"
#include "src/view/presenter.h"
#include "src/view/rebuild_log.h"
#include "src/view/session_file.h"
#include "src/view/stderr_capture.h"
#include "src/view/ui/ui.h"
#include "src/view/undo_scenes.h"
#include "src/view/undo_stack.h"
#include "src/view/view_compare.h"
#include "src/view/view_frame_stats.h"
#include "src/view/view_progressive.h"
#include "src/view/viewport.h"
#include "src/view/window.h"

enum {
    VIEW_BOOKMARK_COUNT = 4,
};

#define VIEW_HOLD 0x80000000u /* marks gesture ids that are not from imgui_gesture() */

struct view {
    const struct app_options *options;
    struct app_image first;      /* initial state, from the options */
    struct session_file session; /* of --session; scene is NULL once it was restored */
    struct signals stop;
    struct stderr_capture echo; /* captures error messages */
    struct window window;
    struct window_x11_shm *canvas; /* MIT-SHM; NULL to present by the driver */
    struct gpu_window_system system;
    struct gpu gpu;
    VkSurfaceKHR surface;
    struct presenter screen;
    struct viewport *picture;
    struct shader_reload *watch; /* shader hot reload; NULL without --watch */
    struct ui *ui;
    struct ui_thumbnails pictures; /* thumbnails for `ui` */
    float ui_scale;                /* scale of text and panels; 0 if not known yet */
    uint32_t theme;                /* index for theme_at() */
    struct window_layout layout;
    struct present_area place; /* position of the image in the last frame */
    VkExtent2D wanted;         /* requested image size; until then the image is shown scaled */
    double resize_at;          /* when to resize the renderer, seconds; 0 if its size is right */
    struct undo_stack history;
    struct undo_scene *opened;   /* scenes that undo can return to */
    uint32_t scene, scene_count; /* current scene number; number of scenes opened so far */
    struct rebuild_log reloads;
    struct camera bookmarks[VIEW_BOOKMARK_COUNT];
    bool bookmarked[VIEW_BOOKMARK_COUNT];
    bool dragged;                           /* the user has orbited the camera once */
    uint32_t hold;                          /* number of mouse button presses */
    uint32_t holds[VIEW_WHEEL - VIEW_DRAG]; /* last press counted for each gesture */
    double now;                             /* time of the current loop iteration, seconds */
    double elapsed;                         /* scene time since motion.time, seconds */
    float shown;                            /* scene time of the last frame drawn, seconds */
    double next;                            /* earliest start of the next frame, seconds */
    bool paused, changed, quit;
    bool recovered;         /* a lost device was reopened; done only once */
    uint32_t message_count; /* validation messages of a lost device */
    bool redrawn;           /* the last frame drew a new image */
    VkExtent2D first_size;  /* window size at startup, pixels */
    bool shoot;             /* save the next frame to files */
    VkExtent2D shoot_size;  /* size to save; 0x0 for the window's */
    bool aims;              /* centre the camera on the surface at (aim_x, aim_y) */
    double aim_x, aim_y;    /* position in the window, pixels */
    bool shoot_copy;        /* copy the next frame to the clipboard instead */
    bool shoot_all;         /* include the panels when saving */
    uint32_t shot_number;   /* number of the last screenshot */
    struct view_frame_stats costs;
    struct view_progressive refine;
    struct view_compare compare;
    bool had_inspector_panel; /* the inspector panel was open in an earlier frame */
    struct pixel_inspector look;
    struct pixel_inspector_choice inspector_wanted; /* choice of the user, not applied yet */
    struct view_identity inspector_seen;            /* view for which `look.layers` was rendered */
};

float view_time(const struct view *view);                 /* scene time, seconds */
void view_seek(struct view *view, float time);            /* sets the scene time, seconds */
void view_set_title(struct view *view, const char *what); /* sets the window title */
void view_show_name(struct view *view);

/* Discards earlier error messages, so that the next view_fail() reports only those that follow. */
void view_clear_errors(struct view *view);
void view_fail(struct view *view, const char *what); /* reports the last error in the status bar */
void view_show_ui(struct view *view, bool shown);
void view_update_layout(struct view *view, VkExtent2D size); /* `size` of the window, pixels */

/* Returns the frame data of the window. `list` is the draw list of the user interface, or NULL. */
struct window_frame view_window(const struct view *view, const struct overlay_draw_list *list);

/* ---- view_actions.c: actions ---- */

void view_execute(struct view *view, enum view_action action);
void view_use_camera(struct view *view, const struct camera *camera);
void view_zoom(struct view *view, float steps);
void view_move_divider(struct view *view, double to); /* as a fraction of the image width */

/* ---- view_edit.c: changes with undo ---- */

struct view_state view_state_now(const struct view *view);

/* Registers that another scene is shown, so that undo can return to the state `before`. */
void view_enter_scene(struct view *view, const struct view_state *before);

/* Returns the settings of the scene without changes by the user. */
struct settings view_scene_settings(const struct view *view);

/* Applies a state. Returns false if that fails, which is reported; the previous state is kept. */
bool view_apply_state(struct view *view, const struct view_state *state);

/* Applies a state and pushes it to the undo stack; `gesture` as in undo_stack_push(). False on
 * failure. */
bool view_edit(struct view *view, const struct view_state *state, uint32_t gesture);
void view_undo_redo(struct view *view, bool again); /* undo, or redo if `again` */

/* Load settings from a preset file, or save them to a new one. */
void view_load_preset(struct view *view, const char *path);
void view_save_preset(struct view *view);

/* Opens a model, environment, preset, session or image, depending on the kind of the file. */
void view_open(struct view *view, const char *path);

/* ---- view_compare.c: A/B comparison ---- */

/* Selects side B of a state. If no state was stored, VIEW_SIDE_B_STATE falls back to the most exact
 * refraction model. */
void view_compare_choose(struct view *view, struct view_state *state, enum view_side_b other);

/* Shows side B of a state. On failure, which is logged, nothing changes. */
MUST_USE enum status view_compare_use(struct view *view, const struct view_state *state);

/* Stops the reference job, because scene or settings are about to change. */
void view_compare_stop(struct view *view);

void view_compare_with(struct view *view, enum view_side_b other);
void view_compare_toggle(struct view *view); /* turns the comparison on or off */
void view_compare_store(struct view *view);  /* stores side A as side B */
void view_compare_flip(struct view *view);   /* shows side B in place of side A, or A again */
void view_compare_toggle_error_map(struct view *view); /* turns the error map on or off */

/* Wait for the next dropped image; test whether a path is accepted as this image; open it as side
 * B. */
void view_compare_await(struct view *view);
bool view_compare_accepts(const struct view *view, const char *path);
void view_compare_open(struct view *view, const char *path);

/* Starts, collects and stops the comparison's worker jobs. Reports their failures. */
void view_compare_follow(struct view *view);

/* Uploads new results of the jobs to the viewport. */
MUST_USE enum status view_compare_show(struct view *view);

/* Writes a label for each side; `right` is empty without a comparison. */
void view_compare_print(const struct view *view, char left[static VIEW_SIDE_SIZE],
                        char right[static VIEW_SIDE_SIZE]);

/* ---- view_input.c: input ---- */

/* Handles all input since the last call. */
void view_handle_input(struct view *view);

/* Runs the panels if they are shown, and carries out what the user chose in them. */
void view_run_ui(struct view *view, VkExtent2D size);

/* ---- view_light_drag.c: light ---- */

/* Rotates the lighting by fractions of the window height: everything (a panorama with its sun) or,
 * if `is_sun`, the sun alone, which can also rise. Shows the reason if nothing can be rotated. */
void view_rotate_light(struct view *view, double right, double down, bool is_sun);

void view_add_exposure(struct view *view, double stops); /* adds stops to the exposure */

/* ---- view_session.c: sessions ---- */

/* Reads a session file. Logs errors. */
MUST_USE enum status view_read_session(struct session_file *session, const char *path,
                                       const struct reader_params *reader);

/* Copies scene, settings and refraction model of a session to a state, which borrows its strings.
 * view_resume_session() restores the rest once the viewport shows that state. */
void view_apply_session(const struct session_file *session, struct app_image *state);
MUST_USE enum status view_resume_session(struct view *view, const struct session_file *session);

void view_load_session(struct view *view, const char *path);
void view_save_session(struct view *view);

/* ---- view_progressive.c: progressive refinement ---- */

/* Creates draft renderers after the first image if they are needed. */
MUST_USE enum status view_progressive_begin(struct view *view);

/* Draws a changed view as a frame of an interaction, at reduced size. */
MUST_USE enum status view_progressive_draw(struct view *view, const struct renderer_shot *shot);

/* Draws one more sample if the view is at rest. *drew tells whether there was something to draw. */
MUST_USE enum status view_progressive_step(struct view *view, bool *drew);

/* Returns the seconds until samples may be drawn; negative if there are none left. */
double view_progressive_wait(const struct view *view);

/* Estimates the seconds until all samples are drawn; 0 if done or unknown. */
double view_progressive_seconds_left(const struct view *view);

/* Returns true if two views are equal except for the exposure. */
bool view_progressive_is_same(const struct view_identity *a, const struct view_identity *b);

/* ---- view_inspect.c: pixel inspector ---- */

/* Renders and shows the inspected layer once the view is at rest. Reports failures. */
void view_inspect(struct view *view);

/* ---- view_screenshot.c: screenshots ---- */

/* Saves or copies the image as requested. Logs failures and continues. */
void view_take_screenshot(struct view *view);

/* Writes the files of --screenshot at exit; PNG files include the panels with --overlay on. */
MUST_USE enum status view_write_outputs(struct view *view);

#endif
