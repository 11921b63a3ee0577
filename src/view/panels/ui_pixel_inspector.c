/* ui_pixel_inspector.c: panel of the pixel inspector: histogram, values, magnifier. */
#include "src/view/panels/ui_pixel_inspector.h"
#include <math.h>
#include <stdio.h>
#include "src/setup/setup_material.h"
#include "src/view/panels/ui_internal.h"

enum {
    ZOOM_COLUMNS = 15, /* pixels shown in the magnifier */
    ZOOM_ROWS = 9,
    ZOOM_CENTER = ZOOM_ROWS / 2 * ZOOM_COLUMNS + ZOOM_COLUMNS / 2,
    NAMES_MAX = PIXEL_INSPECTOR_LAYER_MAX + 1,
};

static const float histogram_height = 64.0f; /* histogram height, pixels at scale 1 */

static uint32_t name_layers(const char *names[static NAMES_MAX])
{
    uint32_t count = 1;
    names[0] = "image";
    for (; count < NAMES_MAX && pixel_inspector_layer(count); count++)
        names[count] = pixel_inspector_layer(count)->name;
    return count;
}

void ui_pixel_inspector_layer_list(const char *label, struct pixel_inspector_choice *c)
{
    const char *names[NAMES_MAX];
    const uint32_t count = name_layers(names);
    const struct frame_layer *now = pixel_inspector_layer(c->layer);
    const char *tip = now ? now->help : "image or layer to show (L)";
    bool changed;
    if (label) {
        changed = imgui_combo(label, names, count, &c->layer);
        imgui_tooltip(tip);
    } else
        changed = ui_named_list("Layer", names, count, &c->layer, tip);
    if (changed)
        c->channel = 0;
}

static void choose_channel(struct pixel_inspector_choice *c)
{
    static const char *const colors[] = { "all", "R", "G", "B" };
    const struct frame_layer *layer = pixel_inspector_layer(c->layer);
    const char *names[FRAME_LAYER_PLANES + 1] = { "all" };
    const uint32_t count = 1 + (layer ? frame_layer_plane_count(layer) : 3);
    for (uint32_t i = 1; i < count; i++)
        names[i] = layer ? layer->planes[i - 1] : colors[i];
    ui_named_list("Channel", names, count, &c->channel, "channel to show, or all");
}

static void choose(struct pixel_inspector_choice *c)
{
    const struct imgui_slider_range stops = { -8.0f, 8.0f, "%.2f stops", false };
    ui_pixel_inspector_layer_list(NULL, c);
    choose_channel(c);
    imgui_align();
    imgui_text("Gain");
    imgui_same_line(imgui_available_width() * 0.4f);
    imgui_next_width(imgui_available_width());
    imgui_slider("##gain", &c->stops, &stops);
    imgui_tooltip("exposure gain of the inspector; changes no setting");
    imgui_checkbox("False colours", &c->false_color);
    imgui_tooltip(
        "false colours from black (minimum) through violet and red to yellow (maximum); key Z");
    imgui_same_line(0.0f);
    if (imgui_button("Reset"))
        *c = (struct pixel_inspector_choice){ 0 };
    imgui_tooltip("show the unmodified image");
}

/* Draws ticks with numbers below the histogram: five, or three if there is less room. */
static void axis(const struct pixel_inspector *inspector)
{
    const float scale = imgui_scale();
    const struct imgui_rect at =
        imgui_reserve(imgui_available_width(), imgui_line_height() + 4.0f * scale);
    const uint32_t last = at.width > 5.0f * imgui_width("-0.0001") ? 4 : 2;
    char text[32];
    for (uint32_t i = 0; i <= last; i++) {
        const float part = (float)i / (float)last;
        const float value = inspector->min + (inspector->max - inspector->min) * part;
        snprintf(text, sizeof(text), "%.3g", (double)value);
        imgui_rectangle(
            (struct imgui_rect){ at.x + part * (at.width - scale), at.y, scale, 4.0f * scale },
            imgui_rgba(imgui_theme()->border));
        imgui_text_beside(at.x + part * (at.width - imgui_width(text)), at.y + 4.0f * scale, text);
    }
}

/* Draws the histogram. Bar heights are square roots, so that small bins are visible. */
static void histogram(const struct pixel_inspector *inspector)
{
    char text[96];
    float bars[PIXEL_INSPECTOR_BIN_COUNT];
    float most = 1.0f;
    for (uint32_t b = 0; b < PIXEL_INSPECTOR_BIN_COUNT; b++) {
        bars[b] = sqrtf((float)inspector->bins[b]);
        most = fmaxf(most, bars[b]);
    }
    imgui_histogram("##histogram", bars, PIXEL_INSPECTOR_BIN_COUNT, 0, most,
                    histogram_height * imgui_scale());
    axis(inspector);
    imgui_text_wrapped(inspector->choice.layer ? "value of the layer, number of pixels"
                                               : "stops relative to 1, number of pixels");
    if (inspector->below_fraction > 0.0f || inspector->above_fraction > 0.0f) {
        snprintf(text, sizeof(text), "%.1f %% below, %.1f %% above",
                 100.0 * (double)inspector->below_fraction,
                 100.0 * (double)inspector->above_fraction);
        imgui_text_dim(text);
    }
}

/* Draws the pixels around (x, y) enlarged; the centre pixel has a frame. */
static void magnifier(const struct ui_view *view, uint32_t x, uint32_t y, const struct theme *theme)
{
    struct pixel_inspector_values v;
    const float side = floorf(imgui_available_width() / ZOOM_COLUMNS);
    const struct imgui_rect all = imgui_reserve(side * ZOOM_COLUMNS, side * ZOOM_ROWS);
    for (uint32_t pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < ZOOM_COLUMNS * ZOOM_ROWS; i++) {
            const uint32_t column = i % ZOOM_COLUMNS;
            const uint32_t row = i / ZOOM_COLUMNS;
            const struct imgui_rect area = { all.x + (float)column * side,
                                             all.y + (float)row * side, side, side };
            if ((i == ZOOM_CENTER) != (pass == 1) ||
                !pixel_inspector_values(view->inspector, view->viewport,
                                        x + column - ZOOM_COLUMNS / 2, y + row - ZOOM_ROWS / 2, &v))
                continue;
            if (pass == 1)
                imgui_rectangle(
                    (struct imgui_rect){ area.x - 2.0f, area.y - 2.0f, side + 4.0f, side + 4.0f },
                    imgui_rgba(theme->accent));
            imgui_rectangle(area, IMGUI_RGBA(v.shown[0], v.shown[1], v.shown[2], 255));
        }
    }
}

static void line(const char *name, const float *values, uint32_t count, const char *unit)
{
    char text[128];
    int length = snprintf(text, sizeof(text), "%s", name);
    for (uint32_t c = 0; c < count && length > 0 && length < (int)sizeof(text); c++)
        length +=
            snprintf(text + length, sizeof(text) - (size_t)length, " %.4g", (double)values[c]);
    if (length > 0 && length < (int)sizeof(text))
        snprintf(text + length, sizeof(text) - (size_t)length, "%s", unit);
    imgui_text_wrapped(text);
}

/* Returns the material preset with the object's refractive index; NULL if there is none. */
static const char *material_of(const struct viewport *p, uint32_t object)
{
    const struct model *model = &p->scene.model;
    const uint32_t count = model->object_count ? model->object_count : 1;
    if (object > count || (count > 1 && p->scene.tables.materials))
        return NULL; /* several objects may have different materials */
    const struct material_preset *preset = setup_find_material(
        &p->state.scene.settings, setup_absorption_scale(p->state.scene.name, &p->scene));
    return preset ? preset->name : NULL;
}

static void values(const struct ui_view *view, const struct pixel_inspector_values *v, uint32_t x,
                   uint32_t y, bool pinned)
{
    char text[160];
    const struct frame_layer *layer = pixel_inspector_layer(view->inspector->choice.layer);
    snprintf(text, sizeof(text), "pixel %u %u%s", x, y, pinned ? " pinned" : "");
    imgui_value(text);
    imgui_tooltip(pinned ? "click the image to unpin" : "click the image to pin");
    line("linear", v->color, 3, "");
    snprintf(text, sizeof(text), "8 bit %u %u %u", v->shown[0], v->shown[1], v->shown[2]);
    imgui_value(text);
    if (layer)
        line(layer->name, v->layer, v->layer_count, "");
    if (!v->object) {
        imgui_value("no surface");
        return;
    }
    line("position", v->position, 3, " m");
    line("normal", v->normal, 3, "");
    line("distance", &v->distance, 1, " m");
    snprintf(text, sizeof(text), "object %u %s", v->object, v->name);
    imgui_value(text);
    imgui_tooltip(text); /* shows names that the panel truncates */
    const char *material = material_of(view->viewport, v->object);
    if (material) {
        snprintf(text, sizeof(text), "material %s", material);
        imgui_value(text);
    }
}

/* Finds the image pixel under the cursor. Returns false if the cursor is not over the image. */
static bool find_pixel(const struct ui *ui, const struct ui_view *view, uint32_t *x, uint32_t *y)
{
    const struct present_area *area = view->image_area;
    const struct setup_image *p = &view->viewport->state;
    const float left = ui->x - (float)area->x;
    const float top = ui->y - (float)area->y;
    if (left < 0.0f || top < 0.0f || left >= (float)area->width || top >= (float)area->height)
        return false;
    *x = (uint32_t)(left * (float)p->width / (float)area->width);
    *y = (uint32_t)(top * (float)p->height / (float)area->height);
    return true;
}

void ui_pixel_inspector_panel(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    struct pixel_inspector_values v;
    choose(&request->inspector_choice);
    imgui_scroll_begin("values");
    if (!view->inspector->sample_count) {
        imgui_text_dim("values are available when the image is at rest");
        imgui_scroll_end();
        return;
    }
    histogram(view->inspector);
    if (!ui->pinned && find_pixel(ui, view, &ui->inspected_x, &ui->inspected_y))
        ui->has_inspected = true;
    if (ui->has_inspected && pixel_inspector_values(view->inspector, view->viewport,
                                                    ui->inspected_x, ui->inspected_y, &v)) {
        values(view, &v, ui->inspected_x, ui->inspected_y, ui->pinned);
        magnifier(view, ui->inspected_x, ui->inspected_y, ui->theme);
    } else {
        imgui_text_dim("point at the image");
    }
    imgui_scroll_end();
}
