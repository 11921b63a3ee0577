/* heat_map_legend.c: draws the colour bar of the FLIP heat map. */
#include "src/lab/ladder/heat_map_legend.h"
#include <stdio.h>
#include "src/lab/metric/heat_map.h"

enum {
    TICKS = 5,
    TICK_LENGTH = 8,    /* pixels */
    NUMBER_COLUMNS = 4, /* characters of a number, "0.25" */
    LETTER = 7,         /* character width at scale 1, pixels */
};

uint32_t legend_numbers(uint32_t scale)
{
    return TICK_LENGTH + NUMBER_COLUMNS * LETTER * scale;
}

void legend_draw(struct canvas *canvas, const uint32_t box[static 4], uint32_t scale)
{
    const uint32_t x = box[0], y = box[1], width = box[2], height = box[3];
    const uint32_t line = scale * CANVAS_TEXT_HEIGHT;
    const uint32_t ticks = height >= TICKS * line ? TICKS : 2; /* a low bar has end ticks */
    uint8_t rgb[3];
    for (uint32_t row = 0; row < height; row++) {
        heat_map_srgb(1.0f - ((float)row + 0.5f) / (float)height, rgb);
        canvas_fill(canvas, (const uint32_t[]){ x, y + row, width, 1 }, rgb);
    }
    for (uint32_t i = 0; i < ticks; i++) {
        char text[16];
        const uint32_t at = i * (height - 1) / (ticks - 1);
        const uint32_t lift = i * line / (ticks - 1);
        snprintf(text, sizeof(text), "%.2f", 1.0 - (double)i / (ticks - 1));
        canvas_draw_text(canvas, x + width + TICK_LENGTH, y + at - (lift < at ? lift : at), scale,
                         text);
    }
}
