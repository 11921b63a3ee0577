/* imgui_state.hpp: private state shared by imgui.cpp and imgui_widgets.cpp. */
#ifndef FIRN_VIEW_UI_IMGUI_STATE_H
#define FIRN_VIEW_UI_IMGUI_STATE_H

#include <imgui.h>
#include <imgui_internal.h>
#include "src/view/panels/imgui.h"

constexpr int panel_count_max = 8;

struct imgui {
    ImGuiContext *context;
    imgui_rect panels[panel_count_max]; /* panels of the current frame */
    int panel_count;
    bool popup;   /* a popup is open */
    bool focuses; /* focus the next text field */
    float scale;
    const theme *colors;
    imgui_item items[IMGUI_ITEM_COUNT];
    uint32_t item_count;
    unsigned active; /* active item ID; 0 if none */
    uint32_t gesture;
    system_font font; /* path "" for the built-in one */
    imgui_thumbnails thumbnails;
    int rects[IMGUI_THUMBNAIL_MAX]; /* atlas rectangles of the thumbnails */
};

inline ImVec4 imgui_state_color(uint32_t rgb)
{
    return { static_cast<float>(rgb >> 16 & 255) / 255.0f,
             static_cast<float>(rgb >> 8 & 255) / 255.0f, static_cast<float>(rgb & 255) / 255.0f,
             1.0f };
}

#endif
