/* diff_sheet.c: draws two images and the image of their errors side by side into a PNG. */
#include "src/app/diff_sheet.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/png.h"
#include "src/file/srgb.h"
#include "src/lab/ladder/heat_map_legend.h"
#include "src/lab/metric/heat_map.h"

enum {
    CELLS = 3,
    MARGIN = 8,   /* pixels */
    LABEL = 100,  /* minimum cell width, pixels */
    BAR = 16,     /* width of the colour scale, pixels */
    BAR_MIN = 40, /* minimum height, pixels */
    LETTERS = 2,  /* letter scale in wide cells */
    GREY = 34,
};

static bool make_heat(const struct diff_sheet *sheet, struct canvas *heat)
{
    if (!canvas_init(heat, sheet->reference->width, sheet->reference->height, 0))
        return false;
    for (size_t i = 0; i < (size_t)heat->width * heat->height; i++) {
        if (!sheet->counted || sheet->counted[i])
            heat_map_srgb(sheet->errors[i], &heat->rgba[4 * i]);
    }
    return true;
}

static bool make_canvas(const struct diff_sheet *sheet, const struct image *image,
                        struct canvas *canvas)
{
    static const char *const names[] = { "R", "G", "B" };
    const float gain = exp2f(sheet->exposure);
    if (!canvas_init(canvas, image->width, image->height, 0))
        return false;
    for (size_t c = 0; c < 3; c++) {
        const float *texels = image_find(image, names[c]);
        for (size_t i = 0; i < (size_t)image->width * image->height; i++) {
            const float value = texels[i] * gain;
            /* NaN becomes black, too */
            const float shown = value > 0.0f ? srgb_encode(value) : 0.0f;
            canvas->rgba[4 * i + c] = (uint8_t)lrintf(shown * 255.0f);
        }
    }
    return true;
}

static enum status encode(const struct canvas *canvas, void **data, size_t *size)
{
    const struct png_image_source source = {
        .rgba = canvas->rgba,
        .width = canvas->width,
        .height = canvas->height,
    };
    return png_encode(&source, data, size);
}

enum status diff_sheet_heat(const struct diff_sheet *sheet, void **data, size_t *size)
{
    struct canvas heat;
    *data = NULL;
    const enum status status =
        make_heat(sheet, &heat) ? encode(&heat, data, size) : log_out_of_memory(NULL);
    free(heat.rgba);
    return status;
}

enum status diff_sheet_all(const struct diff_sheet *sheet, void **data, size_t *size)
{
    const uint32_t width = sheet->reference->width, height = sheet->reference->height;
    const uint32_t cell = width > LABEL ? width : LABEL;
    const uint32_t letters = cell >= LETTERS * LABEL ? LETTERS : 1;
    const uint32_t top = MARGIN + letters * CANVAS_TEXT_HEIGHT + MARGIN / 2;
    const uint32_t bar[4] = { CELLS * (cell + MARGIN) + MARGIN, top, BAR,
                              height > BAR_MIN ? height : BAR_MIN };
    char labels[CELLS][32] = { "reference", "test" };
    struct canvas canvases[CELLS] = { 0 };
    struct canvas canvas = { 0 };
    snprintf(labels[2], sizeof(labels[2]), "FLIP %.4f", sheet->flip);
    *data = NULL;
    const bool ok = make_canvas(sheet, sheet->reference, &canvases[0]) &&
                    make_canvas(sheet, sheet->test, &canvases[1]) &&
                    make_heat(sheet, &canvases[2]) &&
                    canvas_init(&canvas, bar[0] + BAR + legend_numbers(letters) + MARGIN,
                                top + bar[3] + MARGIN, GREY);
    for (uint32_t i = 0; i < CELLS && ok; i++) {
        const uint32_t x = MARGIN + i * (cell + MARGIN);
        canvas_draw_text(&canvas, x, MARGIN, letters, labels[i]);
        canvas_draw_image(&canvas, x, top, &canvases[i]);
    }
    if (ok)
        legend_draw(&canvas, bar, letters);
    const enum status status = ok ? encode(&canvas, data, size) : log_out_of_memory(NULL);
    for (uint32_t i = 0; i < CELLS; i++)
        free(canvases[i].rgba);
    free(canvas.rgba);
    return status;
}
