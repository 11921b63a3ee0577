/* ui_internal.h: state of the user interface and functions shared by its files. */
#ifndef FIRN_VIEW_PANELS_UI_INTERNAL_H
#define FIRN_VIEW_PANELS_UI_INTERNAL_H

#include "src/scene/material_presets.h"
#include "src/view/panels/ui.h"
#include "src/view/panels/ui_input_queue.h"
#include "src/view/panels/ui_pass_times.h"
#include "src/view/panels/ui_setting_groups.h"

enum ui_tab {
    UI_SETTINGS,
    UI_TIMES,
    UI_INSPECT,
};

struct ui {
    struct gpu *gpu;
    struct imgui *imgui;
    struct gpu_image font;
    float scale;
    bool has_font; /* a scalable system font was loaded */
    struct ui_input_queue input;
    struct ui_frame_pacing pace;
    struct ui_pass_times frame_times, right_times, window_times;
    struct overlay_draw_list list;
    VkRect2D image_area;  /* image area of the last frame */
    double last_frame_at; /* seconds; 0 before the first frame */
    bool shown, keys_open, palette_open;
    bool focus_palette, palette_entered; /* requests for the next frame */
    bool release;                        /* return focus to the image afterwards */
    uint32_t palette_row;                /* selected row of the palette */
    char palette_query[64];
    enum ui_tab tab;
    bool open[UI_GROUP_COUNT], shows_all[UI_GROUP_COUNT]; /* per group: open, all rows shown */
    uint32_t material_kind;                               /* kind of the material presets shown */
    const struct material_preset *last_material; /* preset of the last frame; NULL for none */
    const struct theme *theme;
    const struct ui_thumbnails *thumbnails;
    bool focus_panel, focus_search;    /* focus requests for the next frame */
    bool focused_search;               /* focus request was for the search */
    bool has_panel_keys;               /* F6 has given the keys to the panels */
    bool releases_keys;                /* next frame's keys control the image */
    uint32_t focus_wait_frames;        /* frames to wait for the focus */
    uint32_t pending_frames;           /* frames still to be drawn */
    float x, y;                        /* cursor position */
    uint32_t inspected_x, inspected_y; /* last pixel under the cursor */
    bool has_inspected;                /* the cursor was over the image */
    bool pinned;                       /* pixel pinned by a click */
    float press_x, press_y;            /* last left button press */
    float press_reach;                 /* maximum distance of the cursor from the press position */
    unsigned buttons;                  /* bit b: mouse button b pressed */
    bool pressed_panel;                /* they were pressed over a panel */
    bool has_clicked;                  /* the image was clicked at (press_x, press_y) */
    bool has_outline;                  /* an object is outlined in the image */
    char deferred[64];                 /* slider whose value is used when it is released, or "" */
    float deferred_value;
    bool focuses;            /* the next click on the image sets the focus */
    float absorption_length; /* metres of the transmittance colour; 0: not initialised */
    bool is_full;            /* vertex limit exceeded, logged once */
    char filter[64];
    char message[600];
    bool is_failure;       /* `message` is a failure */
    char error[512];       /* persistent error, or "" */
    const char *dump_path; /* ui_dump() file, or NULL */
};

/* Draws the panels. Drawing functions must be called between imgui_begin() and imgui_end(). */
void ui_panels(struct ui *ui, const struct ui_view *view, struct ui_request *request);
void ui_toolbar(const struct ui_view *view, struct ui_request *request);
void ui_command_palette(struct ui *ui, const struct ui_view *view, struct ui_request *request);
void ui_timeline(const struct ui_view *view,
                 struct ui_request *request); /* ui_playback.c: timeline */
void ui_status(const struct ui *ui, const struct ui_view *view, struct ui_request *request);

/* Draws a drop-down list with a label. Returns true if the choice has changed. */
bool ui_named_list(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                   const char *tip);

/* Exclusive choice shown as labelled thumbnails. */
struct ui_gallery {
    const char *name; /* name of what is chosen */
    const char *heading;
    const char *const *names;    /* labels of the values */
    const char *const *tooltips; /* tooltips of the values */
    const uint32_t *thumbnails;  /* thumbnails of the values; NULL for labels only */
    uint32_t count;
};

bool ui_gallery(const struct ui_gallery *gallery, uint32_t *index);

/* Draws a label and a slider. Returns true if the value has changed. */
bool ui_named_slider(const char *name, float *value, const struct imgui_slider_range *range,
                     const char *tip);

/* Draws a label and a colour, sRGB-encoded, that opens a picker. `id` names it for scripts. */
bool ui_named_color(const char *name, const char *id, float color[static 3], const char *tip);

/* Draws a label and exclusive buttons on as many lines as needed. Returns true if one is chosen. */
bool ui_named_buttons(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                      const char *tip);

/* Returns the name of built-in environment i, NULL after the last. The first is "sky". */
const char *ui_environment(uint32_t i);

struct imgui_rect ui_rect_of(VkRect2D rectangle);

/* Draws the colour bar of the error map or of false colours over the image (ui_legend.c). */
void ui_legend(struct ui *ui, const struct ui_view *view);

/* Draws the camera's field of view, focus, bookmarks, directions and projection (ui_camera.c). */
void ui_camera_rows(struct ui *ui, const struct ui_view *view, struct ui_request *request);

/* Draws environments, rotation and exposure of the panorama, and the ground (ui_environment.c). */
void ui_environment_rows(struct ui *ui, const struct ui_view *view, struct ui_request *request);

/* Draws the absorption as the colour of light after a distance (ui_absorption.c). `scale` is the
 * factor on absorption coefficients, setup_absorption_scale(). Returns true if it was changed. */
bool ui_absorption_rows(struct ui *ui, struct settings *settings, float scale);

/* Draws a slider of a value whose change reloads the scene. Returns true if it was released at
 * another value, which it then writes to *value. `name` identifies the slider. */
bool ui_deferred_slider(struct ui *ui, const char *name, float *value,
                        const struct imgui_slider_range *range, const char *tip);

#endif
