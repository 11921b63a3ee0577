/*
 * ui.h: panels over the picture: settings, times, plan, keys.
 *
 * Hears of hands first (ui_hear) and keeps to itself what is meant for panels. Hidden it costs
 * nothing and keeps nothing.
 */
#ifndef FIRN_VIEW_UI_UI_H
#define FIRN_VIEW_UI_UI_H

#include "src/view/history.h"
#include "src/view/layout.h"
#include "src/view/look.h"
#include "src/view/overlay_list.h"
#include "src/view/picture.h"
#include "src/view/reloads.h"
#include "src/view/screen.h"
#include "src/view/ui/theme.h"
#include "src/view/ui/ui_pace.h"
#include "src/view/ui/ui_pictures.h"
#include "src/view/window.h"

struct ui;

/* `scale`: of all sizes; `pictures` outlive the ui. Logs; where there is no font but the built-in
 * one, unless `quiet`. */
MUST_USE enum status ui_create(struct ui **ui, struct gpu *gpu, float scale,
                               const struct theme *theme, const struct ui_pictures *pictures,
                               bool quiet);
void ui_destroy(struct ui *ui); /* may be NULL */

window_listen_fn ui_hear; /* user: the ui */

void ui_show(struct ui *ui, bool shown);
bool ui_is_shown(const struct ui *ui);

/* Shown, and not yet up to date with what hands did. */
bool ui_is_busy(const struct ui *ui);

/* A hand has taken hold of the picture, and of no panel. Then all panels say is how long a frame
 * takes: whether the last frame of theirs is new enough for that. */
bool ui_drags_picture(const struct ui *ui);
bool ui_may_wait(const struct ui *ui, double now);

/* Another size of all there is. ui_font() is another one afterwards: nothing may use it. */
MUST_USE enum status ui_rescale(struct ui *ui, float scale);

void ui_look(struct ui *ui, const struct theme *theme); /* other colours, from the next frame on */

/* Writes to a file, whenever it changes, what hands can use, one a line: left, top, width, height,
 * pixels, and the label; and at 0 0 0 0 how often each action has been done. For programs that
 * use the window. */
void ui_dump(struct ui *ui, const char *path);
void ui_count(struct ui *ui, enum view_action action); /* it was done */

float ui_scale(const struct ui *ui);

/* For screen_lay_over(). */
const struct gpu_image *ui_font(const struct ui *ui);

/* What the panels tell of. */
struct ui_view {
    const struct picture *picture;
    const struct screen *screen;
    struct ui_pace pace; /* of the last frame */
    double now;          /* seconds */
    VkExtent2D size;     /* of the window, pixels */
    const struct history *history;
    const struct reloads *reloads;
    const struct layout *layout; /* of the window */
    const struct look *look;
    struct look_choice look_wanted;
    const struct present_place *place; /* of the picture in the window */
    enum view_other other;
    const char *left, *right; /* what both sides are, in words */
    bool has_stored;          /* VIEW_OTHER_STATE can be shown */
    bool differs;             /* their difference is shown */
    bool paused;
    float time;                         /* of the scene, seconds */
    uint32_t sample_count, sample_goal; /* of the picture that is shown; 0: while it moves */
    double noise;                       /* of it; below 0: not known */
    double seconds_left; /* until all samples are drawn; 0: they are, or it is not known */
    bool is_new;         /* nothing has been dragged yet */
};

/* What a hand wants. */
struct ui_wish {
    enum view_action action; /* VIEW_NOTHING: none */
    char *open;              /* a file or scene, malloc'd; NULL: none */
    bool changed;            /* these: */
    struct settings settings;
    const struct technique *rung;
    uint32_t gesture; /* the same for all changes by one movement of a hand; see imgui.h */
    bool seeks;       /* the scene's time is to be: */
    float time;
    VkExtent2D shot; /* a picture of this size is to be saved; 0x0: none */
    struct look_choice look;
    bool looks;                    /* the panel of values is open */
    enum view_other other;         /* whatever is changed: on the right */
    const struct technique *split; /* the rung there; NULL: it has none */
};

/* Shows or hides what an action names: times, plan, keys. Returns whether it is shown. */
bool ui_toggle(struct ui *ui, enum view_action action);

/* A frame is due, though no hand has done anything. */
void ui_wake(struct ui *ui);

void ui_close_look(struct ui *ui);

/* Words that stand in the panel until others do; cut where they are too long. */
void ui_say(struct ui *ui, const char *words);

/* The same of what went wrong: what to do about it. */
void ui_fail(struct ui *ui, const char *words);

/* What is wrong, until it is not: "". Stands in red. */
void ui_complain(struct ui *ui, const char *words);

/* Runs the panels; before the frame they are drawn in. */
void ui_frame(struct ui *ui, const struct ui_view *view, struct ui_wish *wish);

/* Writes what is to be drawn, nothing while hidden; arrays of OVERLAY_*_COUNT. The list is the
 * ui's. */
const struct overlay_list *ui_take(struct ui *ui, struct overlay_vertex *vertices,
                                   uint32_t *indices);

#endif
