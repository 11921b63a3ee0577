/* view_internal.h: what the files of view.c share. */
#ifndef FIRN_VIEW_VIEW_INTERNAL_H
#define FIRN_VIEW_VIEW_INTERNAL_H

#include "src/app/signals.h"
#include "src/view/history.h"
#include "src/view/look.h"
#include "src/view/picture.h"
#include "src/view/screen.h"
#include "src/view/ui/ui.h"
#include "src/view/view_costs.h"
#include "src/view/view_refine.h"
#include "src/view/window.h"

enum {
    VIEW_BOOKMARK_COUNT = 4,
};

struct view {
    const struct app_options *options;
    struct app_picture first; /* as the options begin it */
    struct signals stop;
    struct window window;
    struct gpu_window_system system;
    struct gpu gpu;
    VkSurfaceKHR surface;
    struct screen screen;
    struct picture *picture;
    struct watch *watch; /* NULL: no shaders are watched */
    struct ui *ui;
    float ui_scale; /* of the panels; 0: not known yet */
    uint32_t theme; /* theme_at() */
    struct layout layout;
    struct present_push place; /* of the picture in the frame drawn last */
    VkExtent2D wanted;         /* of the picture; it is shown scaled until it has this size: */
    double resize_at;          /* seconds; 0: it has */
    struct history history;
    struct camera bookmarks[VIEW_BOOKMARK_COUNT];
    bool bookmarked[VIEW_BOOKMARK_COUNT];
    bool dragged;   /* a hand has moved the picture */
    double now;     /* of the loop, seconds */
    double elapsed; /* of the scene's time, seconds, from motion.time */
    float shown;    /* time of the frame drawn last, seconds */
    double next;    /* the earliest moment for the next frame, seconds */
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
    struct look look;
    struct look_choice look_wanted; /* by hands */
    struct view_seen look_seen;     /* by look.layers */
};

float view_time(const struct view *view);           /* of the scene, seconds */
void view_say(struct view *view, const char *what); /* in the window's title */
void view_show_name(struct view *view);
void view_show_ui(struct view *view, bool shown);
void view_lay_out(struct view *view, VkExtent2D size); /* of the window */

/* ---- view_actions.c: what actions do ---- */

void view_act(struct view *view, enum view_action action);
void view_zoom(struct view *view, float steps);
void view_slide(struct view *view, double to); /* the divider: a part of the picture's width */

/* ---- view_change.c: what undo takes back ---- */

struct view_state view_state_now(const struct view *view);

/* Uses a state. False: what cannot be has been logged and said, what was there stays. */
bool view_use(struct view *view, const struct view_state *state);

/* The same, and undo takes it back. `gesture`: see history.h. */
void view_change(struct view *view, const struct view_state *state, uint32_t gesture);
void view_undo(struct view *view, bool again); /* again: redo */

/* Settings from a preset, and to one. */
void view_load_preset(struct view *view, const char *path);
void view_save_preset(struct view *view);

/* Another object, environment or preset, by what the path ends in. */
void view_open(struct view *view, const char *path);

/* ---- view_input.c: what hands do ---- */

/* All that happened since the last call. */
void view_handle(struct view *view);

/* Runs the panels, if there are any, and does what they are told. */
void view_run_ui(struct view *view, VkExtent2D size);

/* ---- view_refine.c: movement and rest ---- */

/* Draws the picture as it is now if it is another one: small, and shows it. */
MUST_USE enum status view_refine_draw(struct view *view, const struct renderer_shot *shot);

/* Draws one sample more of a picture that is still. *drew: there was one to draw. */
MUST_USE enum status view_refine_step(struct view *view, bool *drew);

/* Seconds until samples may be drawn; below 0: there are none to draw. */
double view_refine_wait(const struct view *view);

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
