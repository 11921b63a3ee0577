/* view_internal.h: what the files of view.c share. */
#ifndef FIRN_VIEW_VIEW_INTERNAL_H
#define FIRN_VIEW_VIEW_INTERNAL_H

#include "src/app/signals.h"
#include "src/view/picture.h"
#include "src/view/screen.h"
#include "src/view/ui/ui.h"
#include "src/view/view_costs.h"
#include "src/view/window.h"

struct view {
    const struct app_options *options;
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
    bool shoot_all;         /* the same with what lies over it */
    uint32_t shot_number;   /* of the screenshot written last */
    struct view_costs costs;
};

void view_say(struct view *view, const char *what); /* in the window's title */
void view_show_name(struct view *view);
void view_show_ui(struct view *view, bool shown);

/* ---- view_hands.c: what hands do ---- */

/* All that happened since the last call. */
void view_handle(struct view *view);

/* Runs the panels, if there are any, and does what they are told. */
void view_run_ui(struct view *view, VkExtent2D size);

/* ---- view_files.c: screenshots ---- */

/* What a key asked for. A failure has been logged and ends nothing. */
void view_shoot(struct view *view);

/* What --screenshot names, at the end. Panels are in PNG files if they were asked for. */
MUST_USE enum status view_write_outputs(struct view *view);

#endif
