/* ui_choice_widgets.c: widgets that choose one of several values: list, buttons. */
#include <stdio.h>
#include "src/scene/bundled_assets.h"
#include "src/view/panels/ui_internal.h"

/* Draws the label on the left of a control that starts at `x`. */
static void head(const char *name, float x, const char *tip)
{
    imgui_indent(8.0f * imgui_scale());
    imgui_align();
    imgui_text_elided(name, x - 14.0f * imgui_scale());
    imgui_tooltip(tip);
}

bool ui_named_list(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                   const char *tip)
{
    char id[64];
    const float x = imgui_available_width() * 0.46f;
    head(name, x, tip);
    imgui_same_line(x);
    imgui_next_width(imgui_available_width());
    snprintf(id, sizeof(id), "##%s", name);
    const bool changed = imgui_combo(id, names, count, index);
    imgui_tooltip(tip);
    return changed;
}

bool ui_named_buttons(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                      const char *tip)
{
    const float all = imgui_available_width();
    const float gap = 6.0f * imgui_scale();
    const float x = all * 0.46f;
    float at = x;
    bool changed = false;
    head(name, x, tip);
    imgui_name(name);
    for (uint32_t i = 0; i < count; i++) {
        const float width = imgui_width(names[i]);
        const bool fits = !i || at + width <= all;
        at = fits ? at : x;
        if (fits)
            imgui_same_line(at);
        else
            imgui_indent(at);
        at += width + gap;
        if (imgui_choice_button(names[i], i == *index)) {
            changed = i != *index;
            *index = i;
        }
        imgui_tooltip(tip);
    }
    return changed;
}

const char *ui_environment(uint32_t i)
{
    if (!i--)
        return "sky";
    for (const struct asset *a = assets; a->name; a++) {
        if (a->kind == ASSET_ENVIRONMENT && !i--)
            return a->name;
    }
    return NULL;
}
