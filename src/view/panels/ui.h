/* ui.h: user interface of the viewer: panels for settings, inspection, pass times and
 * shortcuts. Input events must go to ui_handle_event() first, which consumes events for panels.
 * Hidden panels cost no time and consume no events. */
#ifndef FIRN_VIEW_PANELS_UI_H
#define FIRN_VIEW_PANELS_UI_H

#include "src/scene/material_presets.h"
#include "src/view/panels/theme.h"
#include "src/view/panels/ui_choice_thumbnails.h"
#include "src/view/panels/ui_frame_bottleneck.h"
#include "src/view/pixel_inspector.h"
#include "src/view/scene_objects.h"
#include "src/view/session/undo_stack.h"
#include "src/view/view_renderers.h"
#include "src/view/window/overlay_draw_list.h"
#include "src/view/window/presenter.h"
#include "src/view/window/window.h"
#include "src/view/window/window_layout.h"

struct ui;

/* Creates the user interface. `scale` multiplies all sizes. `thumbnails` must outlive the ui. Logs
 * errors. If only the built-in font is available, logs this unless `quiet`. */
MUST_USE enum status ui_create(struct ui **ui, struct gpu *gpu, float scale,
                               const struct theme *theme, const struct ui_thumbnails *thumbnails,
                               bool quiet);
void ui_destroy(struct ui *ui); /* may be NULL */

window_listen_fn ui_handle_event; /* `user` is the ui */

void ui_show(struct ui *ui, bool shown);
bool ui_is_shown(const struct ui *ui);

/* Returns true if the panels are shown but not yet up to date with the input. */
bool ui_is_busy(const struct ui *ui);

bool ui_drags_image(const struct ui *ui); /* the user drags the image */
/* Returns true if this frame can show the previous panels unchanged. This needs a drag of the image
 * and recently drawn panels. A drag changes nothing in the panels except frame times. */
bool ui_can_skip_frame(const struct ui *ui, double now);

/* Changes the scale and rebuilds the font atlas. No frame in flight may use the old font atlas. */
MUST_USE enum status ui_rescale(struct ui *ui, float scale);

void ui_set_theme(struct ui *ui, const struct theme *theme); /* from the next frame on */

/* Sets the path of a text file that scripts read. Each visible widget has a line: left, top, width
 * and height in pixels, then the label. */
void ui_dump(struct ui *ui, const char *path);

float ui_scale(const struct ui *ui);

/* Returns the font atlas for presenter_set_font(). */
const struct gpu_image *ui_font(const struct ui *ui);

/* Viewer state that the panels display. */
struct ui_view {
    const struct viewport *viewport;
    const struct presenter *presenter;
    struct ui_frame_pacing pace; /* timing of the last frame */
    double now;                  /* seconds */
    VkExtent2D size;             /* size of the window, pixels */
    const struct undo_stack *undo_stack;
    const struct window_layout *layout; /* layout of the window */
    const struct pixel_inspector *inspector;
    struct pixel_inspector_choice inspector_choice;
    const struct present_area *image_area; /* image position in the window */
    enum view_side_b side_b;
    const char *left, *right;               /* labels of sides A and B */
    bool has_stored;                        /* VIEW_SIDE_B_STATE is available */
    bool shows_error_map;                   /* the error map is shown */
    const struct flip_error_map *error_map; /* its errors; NULL while there are none */
    bool paused;
    float time;                         /* scene time, seconds */
    uint32_t sample_count, sample_goal; /* 0 during interaction */
    double seconds_left;                /* 0 if done or unknown */
    double sample_seconds;              /* duration of the last sample; 0 if unknown */
    bool is_first_sample;               /* samples are drawn, but none is shown yet */
    bool is_stopped;                    /* the user has stopped drawing samples */
    bool shows_hint;                    /* the camera was never orbited */
    uint32_t bookmark; /* index of the bookmark that the camera is at; UINT32_MAX for none */
    const struct scene_objects *objects;
    uint32_t selected; /* index of an object; SCENE_OBJECT_NONE if there is none */
    const struct object_outline *outline; /* of the selected object */
};

/* Requests that the user made in the panels during one frame. */
struct ui_request {
    enum view_action action; /* VIEW_ACTION_NONE if none */
    char *open;              /* file or scene to open, malloc'd; NULL if none */
    bool changed;            /* `settings` or `refraction` were changed */
    struct settings settings;
    const struct technique *refraction;
    uint32_t gesture; /* id shared by one drag */
    bool seeks;       /* set the scene time to `time` */
    float time;
    VkExtent2D screenshot_size; /* 0x0 to save no image */
    struct pixel_inspector_choice inspector_choice;
    bool inspects;                   /* the inspector panel is open */
    enum view_side_b side_b;         /* side B, changed independently of `changed` */
    const struct technique *split;   /* model of side B, or NULL */
    float fov_deg;                   /* new field of view; 0 to keep it */
    struct material_choice material; /* for all of the model; preset NULL if there is none */
    bool rotates;                    /* rotate the panorama to `env_rotate`, degrees */
    float env_rotate;
    bool reloads;       /* load the scene with another `env_exposure` or `ground` */
    float env_exposure; /* stops */
    enum stage_ground ground;
    bool focuses; /* focus on what is at (pick_x, pick_y) */
    bool picks;   /* select what is at (pick_x, pick_y), fractions of the image */
    float pick_x, pick_y;
    bool selects; /* select the object of index `selected` */
    uint32_t selected;
    bool overrides; /* give a node a material */
    struct material_override override;
    bool transforms; /* transform, hide or show a node */
    struct object_transform transform;
};

/* Shows or hides the panel that belongs to an action. Returns true if the panel is now shown. */
bool ui_toggle(struct ui *ui, enum view_action action);

/* Requests a frame even if there is no input. */
void ui_wake(struct ui *ui);

void ui_close_inspector(struct ui *ui);

/* Shows a message in the status bar until the next message. Text that does not fit is cut off. */
void ui_show_message(struct ui *ui, const char *message);

/* Shows an error in red in the status bar. The message should advise the user what to do. */
void ui_show_failure(struct ui *ui, const char *message);

/* Shows an error in red until the next call of ui_set_error(). "" removes the error. */
void ui_set_error(struct ui *ui, const char *message);

/* Runs the panels for one frame; call it before drawing that frame. */
void ui_frame(struct ui *ui, const struct ui_view *view, struct ui_request *request);

/* Copies vertices and indices to buffers of OVERLAY_*_COUNT elements. Returns the draw list, which
 * `ui` owns. The list is empty while the panels are hidden. */
const struct overlay_draw_list *ui_copy_draw_list(struct ui *ui, struct overlay_vertex *vertices,
                                                  uint32_t *indices);

#endif
