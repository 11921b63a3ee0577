/* ui_internal.h: state of the user interface and functions shared by its files. */
#ifndef FIRN_VIEW_UI_UI_INTERNAL_H
#define FIRN_VIEW_UI_UI_INTERNAL_H

#include "src/view/ui/ui.h"
#include "src/view/ui/ui_input_queue.h"
#include "src/view/ui/ui_pass_times.h"
#include "src/view/ui/ui_setting_groups.h"

enum ui_tab {
    UI_SETTINGS,
    UI_TIMES,
    UI_PLAN,
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
    VkRect2D picture; /* image area of the last frame; overlapping parts are not docked */
    double last;      /* start of the last frame, seconds; 0 if there was none */
    bool shown, keys_open, palette_open;
    bool focus_palette, palette_entered; /* requests for the next frame */
    bool release;        /* return the keyboard focus to the image after this frame */
    uint32_t palette_at; /* selected row of the palette */
    char palette_words[64];
    enum ui_tab tab;
    bool open[UI_GROUP_COUNT], more[UI_GROUP_COUNT]; /* open groups, and those with all rows */
    const struct theme *theme;
    const struct ui_thumbnails *pictures;
    bool focus_panel, focus_search;    /* focus requests for the next frame */
    bool searches;                     /* the last focus request was for the search field */
    bool released;                     /* keys act on the image from the next frame on */
    uint32_t held;                     /* frames that queued events still wait for the focus */
    uint32_t settle;                   /* frames still to be drawn */
    float x, y;                        /* cursor position */
    uint32_t inspected_x, inspected_y; /* last pixel under the cursor */
    bool has_inspected;                /* the cursor has been over the image */
    bool pinned;                       /* the pixel was pinned by a click */
    float press_x, press_y;            /* position of the last left button press */
    unsigned buttons;                  /* pressed mouse buttons: bit b for button b */
    bool grabbed;                      /* they were pressed over a panel */
    bool is_full;                      /* the vertex limit was exceeded; logged once */
    char filter[64];
    char words[600];
    bool failed;                     /* `words` report a failure */
    char fault[512];                 /* persistent error; "" if none */
    const char *dump;                /* file for the positions of items; NULL if none */
    uint32_t dumped;                 /* hash of its current contents */
    uint32_t done[VIEW_INPUT_COUNT]; /* number of executions of each action */
};

/* Draw parts of the user interface between imgui_begin() and imgui_end(). ui_panels.c: all open
 * panels; ui_toolbar.c: toolbar and status bar; ui_command_palette.c: command palette (Ctrl K). */
void ui_panels(struct ui *ui, const struct ui_view *view, struct ui_request *wish);
void ui_toolbar(const struct ui_view *view, struct ui_request *wish);
void ui_command_palette(struct ui *ui, const struct ui_view *view, struct ui_request *wish);
void ui_timeline(const struct ui_view *view, struct ui_request *wish); /* ui_timeline.c: timeline */
void ui_status(const struct ui *ui, const struct ui_view *view);

/* Draws a drop-down list with a label, like a setting's row. Returns true if the choice has
 * changed. */
bool ui_named_list(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                   const char *tip);

/* A choice of one of several values, shown as thumbnails with labels. */
struct ui_gallery {
    const char *name;         /* name of what is chosen */
    const char *words;        /* heading above the thumbnails */
    const char *const *names; /* labels of the values */
    const char *const *tips;  /* tooltips of the values */
    uint32_t first_picture;   /* thumbnail of the first value; UI_THUMBNAIL_NONE for labels only */
    uint32_t count;
};

bool ui_gallery(const struct ui_gallery *gallery, uint32_t *index);

/* Draws exclusive buttons with a label, wrapped if needed. Returns true if the choice has changed.
 */
bool ui_named_buttons(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                      const char *tip);

/* Returns built-in environment i; 0 is "sky". NULL after the last. */
const char *ui_environment(uint32_t i);

struct imgui_rect ui_rect_of(VkRect2D rectangle);

#endif
