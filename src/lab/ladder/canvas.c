/* canvas.c: 2D drawing into an RGBA image. stb_easy_font draws text as quads. */
#include "src/lab/ladder/canvas.h"
#include <stb/stb_easy_font.h>
#include <stdlib.h>
#include <string.h>

enum {
    GLYPHS_SIZE = 32768, /* glyph quads of about 120 letters */
};

/* Corner of a quad from stb_easy_font_print(). A quad has four corners, clockwise from top left. */
struct corner {
    float x, y, z;
    unsigned char color[4];
};

bool canvas_init(struct canvas *canvas, uint32_t width, uint32_t height, uint8_t grey)
{
    const size_t size = 4 * (size_t)width * height;
    *canvas = (struct canvas){ width, height, malloc(size ? size : 1) };
    if (!canvas->rgba)
        return false;
    memset(canvas->rgba, grey, size);
    for (size_t i = 3; i < size; i += 4)
        canvas->rgba[i] = 255;
    return true;
}

void canvas_fill(struct canvas *canvas, const uint32_t box[static 4], const uint8_t rgb[static 3])
{
    for (uint32_t y = box[1]; y < box[1] + box[3] && y < canvas->height; y++) {
        for (uint32_t x = box[0]; x < box[0] + box[2] && x < canvas->width; x++)
            memcpy(&canvas->rgba[4 * ((size_t)y * canvas->width + x)], rgb, 3);
    }
}

void canvas_draw_image(struct canvas *canvas, uint32_t x, uint32_t y, const struct canvas *source)
{
    if (x >= canvas->width)
        return;
    const uint32_t left = canvas->width - x;
    const size_t size = 4 * (size_t)(source->width < left ? source->width : left);
    for (uint32_t row = 0; row < source->height && y + row < canvas->height; row++)
        memcpy(&canvas->rgba[4 * ((size_t)(y + row) * canvas->width + x)],
               &source->rgba[4 * (size_t)row * source->width], size);
}

void canvas_draw_text(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t scale,
                      const char *text)
{
    static const uint8_t light[3] = { 235, 235, 235 };
    char letters[128];
    char bytes[GLYPHS_SIZE];
    size_t length = strlen(text);
    if (length >= sizeof(letters))
        length = sizeof(letters) - 1;
    memcpy(letters, text, length); /* stb_easy_font_print() takes a mutable string */
    letters[length] = '\0';
    const int count = stb_easy_font_print(0.0f, 0.0f, letters, NULL, bytes, sizeof(bytes));
    for (int i = 0; i < count; i++) {
        struct corner corners[4];
        memcpy(corners, bytes + (size_t)i * sizeof(corners), sizeof(corners));
        const uint32_t box[4] = {
            x + scale * (uint32_t)corners[0].x,
            y + scale * (uint32_t)corners[0].y,
            scale * (uint32_t)(corners[2].x - corners[0].x),
            scale * (uint32_t)(corners[2].y - corners[0].y),
        };
        canvas_fill(canvas, box, light);
    }
}
