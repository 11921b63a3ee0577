/* ui_internal.h: what the files of ui.c share. */
#ifndef FIRN_VIEW_UI_UI_INTERNAL_H
#define FIRN_VIEW_UI_UI_INTERNAL_H

#include "src/view/ui/ui.h"
#include "src/view/ui/ui_groups.h"
#include "src/view/ui/ui_input.h"
#include "src/view/ui/ui_times.h"

enum ui_tab {
    UI_SETTINGS,
    UI_TIMES,
    UI_PLAN,
    UI_LOOK,
};

struct ui {
    struct gpu *gpu;
    struct imgui *imgui;
    struct gpu_image font;
    float scale;
    bool has_font; /* of the system */
    struct ui_input input;
    struct ui_pace pace;
    struct ui_times frame_times, right_times, window_times;
    struct overlay_list list;
    VkRect2D picture; /* of the last frame: what is not docked is over it */
    double last;      /* when the last frame began, seconds; 0: there was none */
    bool shown, keys_open, palette_open;
    bool focus_palette, palette_entered; /* in the next frame */
    bool release;                        /* at the end of this one keys are the picture's */
    uint32_t palette_at;                 /* the row that Enter chooses */
    char palette_words[64];
    enum ui_tab tab;
    bool open[UI_GROUP_COUNT], more[UI_GROUP_COUNT]; /* groups of settings, and all their rows */
    const struct theme *theme;
    const struct ui_pictures *pictures;
    bool focus_panel, focus_search; /* in the next frame */
    bool searches;                  /* the last of these was the search */
    bool released;                  /* keys are the picture's again; from the next frame on */
    uint32_t held;                  /* frames that events still wait for the line of the search */
    uint32_t settle;                /* frames still to be drawn */
    float x, y;                     /* of the cursor */
    uint32_t look_x, look_y;        /* the pixel it was over last */
    bool has_looked;                /* it was over one */
    bool pinned;                    /* a click has chosen that pixel */
    float press_x, press_y;         /* where the left button went down */
    unsigned buttons;               /* that are down: bit b for button b */
    bool grabbed;                   /* they went down on a panel */
    bool is_full;                   /* has been said */
    char filter[64];
    char words[600];
    bool failed;                    /* they tell of a failure */
    char fault[512];                /* "": none */
    const char *dump;               /* file for the places of what is shown; NULL: none */
    uint32_t dumped;                /* hash of what was written to it */
    uint32_t done[VIEW_DEED_COUNT]; /* how often, so far */
};

/* Between imgui_begin() and imgui_end(). ui_panels.c: all that are open; ui_bar.c: the bar above
 * the picture, and the line below it; ui_palette.c: what Ctrl K opens. */
void ui_panels(struct ui *ui, const struct ui_view *view, struct ui_wish *wish);
void ui_bar(const struct ui_view *view, struct ui_wish *wish);
void ui_palette(struct ui *ui, const struct ui_view *view, struct ui_wish *wish);
void ui_time(const struct ui_view *view, struct ui_wish *wish); /* ui_time.c: play and seek */
void ui_status(const struct ui *ui, const struct ui_view *view);

/* A list with its name in front, like rows of settings. Returns whether the choice has changed. */
bool ui_named_list(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                   const char *tip);

/* A choice of pictures with their names, in as many rows as they need. */
struct ui_gallery {
    const char *name;         /* of what is chosen */
    const char *words;        /* about it, in the line above */
    const char *const *names; /* of its values */
    const char *const *tips;  /* what each is */
    uint32_t first_picture;   /* of the first value; UI_PICTURE_NONE: words alone */
    uint32_t count;
};

bool ui_gallery(const struct ui_gallery *gallery, uint32_t *index);

/* The same as buttons in as many lines as they need: one click. */
bool ui_named_buttons(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                      const char *tip);

/* The environments that come with firn; "sky" is the first, NULL the end. */
const char *ui_environment(uint32_t i);

struct imgui_place ui_place(VkRect2D rectangle);

#endif
