/* view_internal.h: what the files of view.c share. */
#ifndef FIRN_VIEW_VIEW_INTERNAL_H
#define FIRN_VIEW_VIEW_INTERNAL_H

#include "src/app/signals.h"
#include "src/view/echo.h"
#include "src/view/history.h"
#include "src/view/look.h"
#include "src/view/opened.h"
#include "src/view/picture.h"
#include "src/view/reloads.h"
#include "src/view/screen.h"
#include "src/view/session.h"
#include "src/view/ui/ui.h"
#include "src/view/view_compare.h"
#include "src/view/view_costs.h"
#include "src/view/view_refine.h"
#include "src/view/window.h"

enum {
    VIEW_BOOKMARK_COUNT = 4,
};

#define VIEW_HOLD 0x80000000u /* in a gesture's number: it is none of imgui_gesture() */

struct view {
    const struct app_options *options;
    struct app_picture first; /* as the options begin it */
    struct session session;   /* of --session; scene NULL: none, or it has been resumed */
    struct signals stop;
    struct echo echo; /* of what is logged */
    struct window window;
    struct window_canvas *canvas; /* NULL: pictures go through the driver */
    struct gpu_window_system system;
    struct gpu gpu;
    VkSurfaceKHR surface;
    struct screen screen;
    struct picture *picture;
    struct watch *watch; /* NULL: no shaders are watched */
    struct ui *ui;
    struct ui_pictures pictures; /* for it */
    float ui_scale;              /* of the panels; 0: not known yet */
    uint32_t theme;              /* theme_at() */
    struct layout layout;
    struct present_place place; /* of the picture in the frame drawn last */
    VkExtent2D wanted;          /* of the picture; it is shown scaled until it has this size: */
    double resize_at;           /* seconds; 0: it has */
    struct history history;
    struct opened *opened;       /* scenes that were left */
    uint32_t scene, scene_count; /* the one in use; those that there were before it */
    struct reloads reloads;
    struct camera bookmarks[VIEW_BOOKMARK_COUNT];
    bool bookmarked[VIEW_BOOKMARK_COUNT];
    bool dragged;                           /* a hand has moved the picture */
    uint32_t hold;                          /* how often buttons of the mouse went down */
    uint32_t holds[VIEW_WHEEL - VIEW_DRAG]; /* the last one that was counted as each gesture */
    double now;                             /* of the loop, seconds */
    double elapsed;                         /* of the scene's time, seconds, from motion.time */
    float shown;                            /* time of the frame drawn last, seconds */
    double next;                            /* the earliest moment for the next frame, seconds */
    bool paused, changed, quit;
    bool recovered;         /* from the loss of a device: once is enough */
    uint32_t message_count; /* of the validation layer, about a device that was lost */
    bool redrawn;           /* the last frame has another picture than the one before */
    VkExtent2D first_size;  /* of the window, pixels */
    bool shoot;             /* the next frame, to files */
    VkExtent2D shoot_size;  /* of it; 0x0: as it is */
    bool aims;              /* the camera is to look at what is at: */
    double aim_x, aim_y;    /* pixels of the window */
    bool shoot_copy;        /* the same, to the clipboard alone */
    bool shoot_all;         /* the same with what lies over it */
    uint32_t shot_number;   /* of the screenshot written last */
    struct view_costs costs;
    struct view_refine refine;
    struct view_compare compare;
    bool has_look_panel; /* a frame has shown it */
    struct look look;
    struct look_choice look_wanted; /* by hands */
    struct view_seen look_seen;     /* by look.layers */
};

float view_time(const struct view *view);           /* of the scene, seconds */
void view_seek(struct view *view, float time);      /* to another one */
void view_say(struct view *view, const char *what); /* in the window's title */
void view_show_name(struct view *view);

/* What is logged from now on is why view_fail() is called next. */
void view_attempt(struct view *view);
void view_fail(struct view *view, const char *what); /* in the line below the picture */
void view_show_ui(struct view *view, bool shown);
void view_lay_out(struct view *view, VkExtent2D size); /* of the window */

/* What the window shows, with a list of what lies over the picture; NULL: nothing. */
struct window_frame view_window(const struct view *view, const struct overlay_list *list);

/* ---- view_actions.c: what actions do ---- */

void view_act(struct view *view, enum view_action action);
void view_use_camera(struct view *view, const struct camera *camera);
void view_zoom(struct view *view, float steps);
void view_slide(struct view *view, double to); /* the divider: a part of the picture's width */

/* ---- view_change.c: what undo takes back ---- */

struct view_state view_state_now(const struct view *view);

/* The picture is of another scene, which undo may leave; `before`: the state until then. */
void view_enter_scene(struct view *view, const struct view_state *before);

/* The settings that the scene would have if no hand had changed any. */
struct settings view_brought(const struct view *view);

/* Uses a state. False: what cannot be has been logged and said, what was there stays. */
bool view_use(struct view *view, const struct view_state *state);

/* The same, and undo takes it back. `gesture`: see history.h. */
bool view_change(struct view *view, const struct view_state *state, uint32_t gesture);
void view_undo(struct view *view, bool again); /* again: redo */

/* Settings from a preset, and to one. */
void view_load_preset(struct view *view, const char *path);
void view_save_preset(struct view *view);

/* Another object, environment or preset, by what the path ends in. */
void view_open(struct view *view, const char *path);

/* ---- view_compare.c: two sides ---- */

/* Puts something onto the right of a state; where nothing was stored, the most exact rung takes the
 * place of the stored state. */
void view_compare_choose(struct view *view, struct view_state *state, enum view_other other);

/* Shows what a state has on the right. On failure, which has been logged, all stays. */
MUST_USE enum status view_compare_use(struct view *view, const struct view_state *state);

/* The reference is not traced any more: scene or settings are about to change. */
void view_compare_stop(struct view *view);

void view_compare_with(struct view *view, enum view_other other);
void view_compare_toggle(struct view *view); /* something is on the right, or nothing */
void view_compare_store(struct view *view);  /* for the right: what is on the left */
void view_compare_flip(struct view *view);   /* the right in place of the left, or not */
void view_compare_differ(struct view *view); /* the errors between both, or not */

/* The next picture that comes is for the right; whether this file is one; and its use. */
void view_compare_await(struct view *view);
bool view_compare_takes(const struct view *view, const char *path);
void view_compare_open(struct view *view, const char *path);

/* What goes on beside the loop is begun, taken or ended. Failures are said. */
void view_compare_follow(struct view *view);

/* What has come of it is in the picture afterwards. */
MUST_USE enum status view_compare_show(struct view *view);

/* What both sides are, in words; right "": nothing. */
void view_compare_print(const struct view *view, char left[static VIEW_SIDE_SIZE],
                        char right[static VIEW_SIDE_SIZE]);

/* ---- view_input.c: what hands do ---- */

/* All that happened since the last call. */
void view_handle(struct view *view);

/* Runs the panels, if there are any, and does what they are told. */
void view_run_ui(struct view *view, VkExtent2D size);

/* ---- view_light.c: light ---- */

/* By parts of the window's height: all light there is (of a panorama its sun, too), or the sun
 * alone, which also rises. Says why where nothing can be turned. */
void view_turn_light(struct view *view, double right, double down, bool is_sun);

void view_expose(struct view *view, double stops); /* brighter by so many */

/* ---- view_session.c: sessions ---- */

/* Reads a file of view_save_session(). Logs. */
MUST_USE enum status view_read_session(struct session *session, const char *path,
                                       const struct reader_params *reader);

/* Puts into a state what a picture is made of; names are those of the session. The rest of it comes
 * into the view when that picture is there. */
void view_apply_session(const struct session *session, struct app_picture *state);
MUST_USE enum status view_resume_session(struct view *view, const struct session *session);

void view_load_session(struct view *view, const char *path);
void view_save_session(struct view *view);

/* ---- view_refine.c: movement and rest ---- */

/* After the first picture: makes what movements are drawn with, if it takes long. */
MUST_USE enum status view_refine_begin(struct view *view);

/* Draws the picture as it is now if it is another one: small, and shows it. */
MUST_USE enum status view_refine_draw(struct view *view, const struct renderer_shot *shot);

/* Draws one sample more of a picture that is still. *drew: there was one to draw. */
MUST_USE enum status view_refine_step(struct view *view, bool *drew);

/* Seconds until samples may be drawn; below 0: there are none to draw. */
double view_refine_wait(const struct view *view);

/* Seconds until all samples are drawn, as those before took; 0: they are, or nothing is known. */
double view_refine_left(const struct view *view);

/* Whether both see the same, but for the exposure. */
bool view_refine_is_same(const struct view_seen *a, const struct view_seen *b);

/* ---- view_look.c: layers and values ---- */

/* Draws and shows what hands look at, once the picture is still. Failures are said. */
void view_look(struct view *view);

/* ---- view_files.c: screenshots ---- */

/* What a key asked for. A failure has been logged and ends nothing. */
void view_shoot(struct view *view);

/* What --screenshot names, at the end. Panels are in PNG files if they were asked for. */
MUST_USE enum status view_write_outputs(struct view *view);

#endif
