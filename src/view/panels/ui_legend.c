/* ui_legend.c: colour bar with numbers over the image, for the error map and false colours. */
#include <math.h>
#include <stdio.h>
#include "src/lab/metric/heat_map.h"
#include "src/view/compare/flip_error_map.h"
#include "src/view/panels/ui_internal.h"

enum {
    STEP_COUNT = 48, /* steps of the colour bar */
};

static const float legend_width = 220.0f; /* lengths are pixels at scale 1 */
static const float bar_height = 10.0f;

static void draw_bar(const struct imgui_rect *area)
{
    const float step = area->width / STEP_COUNT;
    for (uint32_t i = 0; i < STEP_COUNT; i++) {
        uint8_t c[3];
        heat_map_srgb(((float)i + 0.5f) / STEP_COUNT, c);
        imgui_rectangle(
            (struct imgui_rect){ area->x + (float)i * step, area->y, step + 1.0f, area->height },
            IMGUI_RGBA(c[0], c[1], c[2], 255));
    }
}

/* Draws a legend in the upper right corner of the image. */
static void draw_legend(struct ui *ui, const struct ui_view *view, const char *title, float min,
                        float max)
{
    const struct present_area *p = view->image_area;
    const float scale = ui->scale;
    const float width = fminf(legend_width * scale, (float)p->width);
    const float height = 2.0f * imgui_line_height() + (bar_height + 18.0f) * scale;
    const struct imgui_rect area = { (float)(p->x + p->width) - width, (float)p->y, width, height };
    char text[32];
    if ((float)p->height < 2.0f * height)
        return;
    imgui_panel_begin(ui->imgui, "legend", area, IMGUI_LABEL);
    imgui_text_elided(title, imgui_available_width());
    imgui_name(title);
    const struct imgui_rect bar = imgui_reserve(imgui_available_width(), bar_height * scale);
    draw_bar(&bar);
    for (int i = 0; i < 3; i++) {
        snprintf(text, sizeof(text), "%.3g", (double)(min + (max - min) * (float)i / 2.0f));
        const float room = bar.width - imgui_width(text);
        imgui_text_beside(bar.x + room * (float)i / 2.0f, bar.y + bar.height, text);
    }
    imgui_panel_end();
}

void ui_legend(struct ui *ui, const struct ui_view *view)
{
    char title[128];
    const struct pixel_inspector *inspector = view->inspector;
    const struct frame_layer *layer = pixel_inspector_layer(inspector->choice.layer);
    if (view->error_map) {
        snprintf(title, sizeof(title), "FLIP: mean %.3f, 95 %% %.3f", view->error_map->mean,
                 view->error_map->percentile_95);
        draw_legend(ui, view, title, 0.0f, 1.0f);
    } else if (!view->shows_error_map && inspector->rgba && inspector->choice.false_color) {
        snprintf(title, sizeof(title), "%s", layer ? layer->name : "mean of R, G, B");
        draw_legend(ui, view, title, inspector->shown_min, inspector->shown_max);
    }
}
