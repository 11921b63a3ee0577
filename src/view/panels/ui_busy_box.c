/* ui_busy_box.c: draws a spinner and a line of text into pixels of the host. */
#include "src/view/panels/ui_busy_box.h"
#include <math.h>
#include <stdlib.h>
#include "src/view/panels/ui_internal.h"

static const float pi = 3.14159265f;
static const float margin = 14.0f; /* lengths are pixels at scale 1 */
static const float radius = 10.0f, thickness = 3.0f;

/* Returns colour `a` for weight 0, `b` for 1. */
static uint32_t blend(uint32_t a, uint32_t b, float weight)
{
    uint32_t mixed = 0;
    for (uint32_t shift = 0; shift < 24; shift += 8) {
        const float from = (float)(a >> shift & 255);
        const float to = (float)(b >> shift & 255);
        mixed |= (uint32_t)(from + (to - from) * weight + 0.5f) << shift;
    }
    return mixed;
}

/* Draws a ring that fades along its circumference. */
static void draw_spinner(const struct ui *ui, const struct ui_busy_box *box, double seconds)
{
    const float center = (float)box->height / 2.0f;
    const float turn = (float)(seconds - floor(seconds));
    for (uint32_t y = 0; y < box->height; y++) {
        for (uint32_t x = 0; x < box->height; x++) {
            const float dx = (float)x + 0.5f - center;
            const float dy = (float)y + 0.5f - center;
            const float off = fabsf(hypotf(dx, dy) - radius * ui->scale);
            const float part = atan2f(dy, dx) / (2.0f * pi) - turn;
            const float cover = fminf(fmaxf(thickness * ui->scale / 2.0f + 0.5f - off, 0.0f), 1.0f);
            uint32_t *pixel = &box->pixels[y * box->width + x];
            *pixel = blend(*pixel, ui->theme->accent, cover * (part - floorf(part)));
        }
    }
}

struct ui_busy_box ui_busy_box_draw(const struct ui *ui, const char *text, double seconds)
{
    const float height = 2.0f * (margin + radius) * ui->scale;
    const float width = imgui_painted_width(ui->imgui, text) + height + margin * ui->scale;
    struct ui_busy_box box = { .width = (uint32_t)width, .height = (uint32_t)height };
    box.pixels = malloc((size_t)box.width * box.height * sizeof(*box.pixels));
    for (uint32_t i = 0; i < box.width * box.height && box.pixels; i++) {
        const uint32_t x = i % box.width;
        const uint32_t y = i / box.width;
        const bool edge = !x || !y || x + 1 == box.width || y + 1 == box.height;
        box.pixels[i] = edge ? ui->theme->border : ui->theme->panel;
    }
    if (!box.pixels)
        return box;
    draw_spinner(ui, &box, seconds);
    imgui_paint_text(ui->imgui, text, (int)height,
                     &(struct imgui_canvas){ box.pixels, box.width, box.height, ui->theme->text });
    return box;
}
