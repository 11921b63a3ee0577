/* ui_choice_widgets.c: widgets that choose one of several values: list, buttons, thumbnails. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "src/scene/bundled_assets.h"
#include "src/view/panels/ui_internal.h"

enum {
    ID_SIZE = 64,
    BUTTON_MAX = 8, /* maximum number of values shown as buttons; more are shown as a list */
};

static const float cell_width = 63.0f; /* minimum width per thumbnail, pixels at scale 1 */
static const float cell_gap = 6.0f;
static const float label_fraction = 0.49f; /* start of the control / row width */
static const float narrow = 200.0f;        /* below this width, controls are below their labels */

/* Draws the label on the left of a control that starts at `x`. */
static void head(const char *name, float x, const char *tip)
{
    imgui_indent(8.0f * imgui_scale());
    imgui_align();
    imgui_text_elided(name, x - 14.0f * imgui_scale());
    imgui_tooltip(tip);
}

/* Draws the label of a control that fills the rest of the row. Writes the control's label to `id`.
 */
static void begin_row(const char *name, const char *tip, char id[static ID_SIZE])
{
    const float x = imgui_available_width() * label_fraction;
    const bool is_narrow = imgui_available_width() < narrow * imgui_scale();
    head(name, is_narrow ? imgui_available_width() : x, tip);
    if (is_narrow)
        imgui_indent(8.0f * imgui_scale());
    else
        imgui_same_line(x);
    imgui_next_width(imgui_available_width());
    snprintf(id, ID_SIZE, "##%s", name);
}

bool ui_named_list(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                   const char *tip)
{
    char id[ID_SIZE];
    begin_row(name, tip, id);
    const bool changed = imgui_combo(id, names, count, index);
    imgui_tooltip(tip);
    return changed;
}

bool ui_named_slider(const char *name, float *value, const struct imgui_slider_range *range,
                     const char *tip)
{
    char id[ID_SIZE];
    begin_row(name, tip, id);
    const bool changed = imgui_slider(id, value, range);
    imgui_tooltip(tip);
    return changed;
}

bool ui_named_color(const char *name, const char *id, float color[static 3], const char *tip)
{
    char unused[ID_SIZE];
    char label[ID_SIZE];
    begin_row(name, tip, unused);
    snprintf(label, sizeof(label), "##%s", id);
    const bool changed = imgui_color(label, color);
    imgui_tooltip(tip);
    return changed;
}

bool ui_deferred_slider(struct ui *ui, const char *name, float *value,
                        const struct imgui_slider_range *range, const char *tip)
{
    float shown = !strcmp(ui->deferred, name) ? ui->deferred_value : *value;
    if (ui_named_slider(name, &shown, range, tip)) {
        snprintf(ui->deferred, sizeof(ui->deferred), "%s", name);
        ui->deferred_value = shown;
    }
    if (strcmp(ui->deferred, name) != 0 || imgui_is_item_active())
        return false;
    *ui->deferred = '\0';
    const bool changed = shown < *value || shown > *value;
    *value = shown;
    return changed;
}

bool ui_named_buttons(const char *name, const char *const *names, uint32_t count, uint32_t *index,
                      const char *tip)
{
    const float all = imgui_available_width();
    const float gap = 6.0f * imgui_scale();
    const float x = all * label_fraction;
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

/* Returns the width of a thumbnail that has room for every name. */
static float widest_cell(const struct ui_gallery *g)
{
    float width = cell_width * imgui_scale();
    for (uint32_t i = 0; i < g->count; i++)
        width = fmaxf(width, imgui_width(g->names[i]));
    return width;
}

bool ui_gallery(const struct ui_gallery *g, uint32_t *index)
{
    const float scale = imgui_scale();
    const float gap = cell_gap * scale;
    const float margin = 8.0f * scale;
    const float room = imgui_available_width() - margin;
    const float fits = floorf((room + gap) / (widest_cell(g) + gap));
    const uint32_t columns = fits > 1.0f ? (uint32_t)fits : 1;
    const float width = floorf((room + gap) / (float)columns - gap);
    bool changed = false;
    if (!g->thumbnails)
        return g->count > BUTTON_MAX
                   ? ui_named_list(g->name, g->names, g->count, index, g->heading)
                   : ui_named_buttons(g->name, g->names, g->count, index, g->heading);
    imgui_indent(margin);
    imgui_text_elided(g->heading, room);
    imgui_name(g->name);
    for (uint32_t i = 0; i < g->count; i++) {
        if (i % columns)
            imgui_same_line(0.0f);
        else
            imgui_indent(margin);
        if (imgui_thumbnail_button(g->names[i], g->thumbnails[i], width, i == *index)) {
            changed = i != *index;
            *index = i;
        }
        imgui_tooltip(g->tooltips[i]);
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
