/* imgui_state.hpp: what imgui.cpp and imgui_widgets.cpp share; in C++. */
#ifndef FIRN_VIEW_UI_IMGUI_STATE_H
#define FIRN_VIEW_UI_IMGUI_STATE_H

#include <imgui.h>
#include <imgui_internal.h>
#include "src/view/ui/imgui.h"

constexpr int panel_count_max = 8;

struct imgui {
    ImGuiContext *context;
    imgui_place panels[panel_count_max]; /* of the frame */
    int panel_count;
    bool popup;   /* a list is open */
    bool focuses; /* the next line of text gets the keys */
    float scale;
    const theme *look;
    imgui_item items[IMGUI_ITEM_COUNT];
    uint32_t item_count;
    unsigned active; /* what a hand has hold of; 0: nothing */
    uint32_t gesture;
    font system; /* path "": the built-in one */
    imgui_pictures pictures;
    int places[IMGUI_PICTURE_MAX]; /* of pictures in the font's image, as the library counts them */
};

inline ImVec4 imgui_state_color(uint32_t rgb)
{
    return { static_cast<float>(rgb >> 16 & 255) / 255.0f,
             static_cast<float>(rgb >> 8 & 255) / 255.0f, static_cast<float>(rgb & 255) / 255.0f,
             1.0f };
}

#endif
