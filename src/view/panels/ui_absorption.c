/* ui_absorption.c: rows that edit absorption as the transmittance colour at a distance. */
#include <math.h>
#include <stdio.h>
#include "src/file/srgb.h"
#include "src/tech/refract/absorption.h"
#include "src/view/panels/ui_internal.h"

/* Minimum transmittance of a channel of the colour; 0 would need infinite absorption. */
static const float darkest = 1e-3f;

static void rows_of(const struct setting *rows[static 3])
{
    rows[0] = settings_row(&absorb_settings, offsetof(struct absorb_params, red));
    rows[1] = settings_row(&absorb_settings, offsetof(struct absorb_params, green));
    rows[2] = settings_row(&absorb_settings, offsetof(struct absorb_params, blue));
}

bool ui_absorption_rows(struct ui *ui, struct settings *settings, float scale)
{
    static const struct imgui_slider_range lengths = { 0.001f, 1.0f, "%.3g m", true };
    static const char tip[] =
        "colour of white light after this distance in the material: Beer's law, "
        "settings absorb.red, .green and .blue";
    const struct setting *rows[3];
    float color[3];
    if (!(ui->absorption_length > 0.0f))
        ui->absorption_length = MATERIAL_COLOR_LENGTH;
    const float length = ui->absorption_length;
    char name[48];
    rows_of(rows);
    for (int c = 0; c < 3; c++)
        color[c] = srgb_encode(expf(-(float)settings_get(settings, rows[c]) / scale * length));
    snprintf(name, sizeof(name), "Colour after %.3g %s",
             (double)(length < 1.0f ? length * 100.0f : length), length < 1.0f ? "cm" : "m");
    bool changed = ui_named_color(name, "absorption colour", color, tip);
    changed = ui_named_slider("Distance", &ui->absorption_length, &lengths,
                              "distance after which light has the colour above: a change keeps the "
                              "colour") ||
              changed;
    for (int c = 0; c < 3 && changed; c++) {
        const float kept = fmaxf(srgb_decode(color[c]), darkest);
        const double absorbed = -log((double)fminf(kept, 1.0f)) / (double)ui->absorption_length;
        settings_set_value(settings, rows[c], fmin(absorbed * (double)scale, rows[c]->max));
    }
    return changed;
}
