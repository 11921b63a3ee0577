/* ui_internal.h: what the files of ui.c share. */
#ifndef FIRN_VIEW_UI_UI_INTERNAL_H
#define FIRN_VIEW_UI_UI_INTERNAL_H

#include "src/view/ui/ui.h"
#include "src/view/ui/ui_input.h"
#include "src/view/ui/ui_times.h"

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
    double last; /* when the last frame began, seconds; 0: there was none */
    bool shown, times_open, plan_open, keys_open;
    bool focus_panel, focus_search; /* in the next frame */
    bool searches;                  /* the last of these was the search */
    bool released;                  /* keys are the picture's again; from the next frame on */
    uint32_t held;                  /* frames that events still wait for the line of the search */
    uint32_t settle;                /* frames still to be drawn */
    float x, y;                     /* of the cursor */
    unsigned buttons;               /* that are down: bit b for button b */
    bool grabbed;                   /* they went down on a panel */
    bool is_full;                   /* has been said */
    char filter[64];
    char words[96];
    char fault[512]; /* "": none */
};

/* ui_panels.c: all that are open, between imgui_begin() and imgui_end(). */
void ui_panels(struct ui *ui, const struct ui_view *view, struct ui_wish *wish);

#endif
