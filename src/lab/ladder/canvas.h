/* canvas.h: RGBA image with functions to draw boxes, images and text. */
#ifndef FIRN_LAB_LADDER_CANVAS_H
#define FIRN_LAB_LADDER_CANVAS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    CANVAS_TEXT_HEIGHT = 12 /* height of a text line, pixels */
};

struct canvas {
    uint32_t width, height; /* pixels */
    uint8_t *rgba;          /* opaque sRGB, rows top to bottom */
};

/* Allocates a grey canvas, which the caller frees. Returns false when out of memory. */
bool canvas_init(struct canvas *canvas, uint32_t width, uint32_t height, uint8_t grey);

/* Fills a box (left, top, width, height in pixels), clipped to the canvas. */
void canvas_fill(struct canvas *canvas, const uint32_t box[static 4], const uint8_t rgb[static 3]);
/* Copies an image to (x, y), clipped to the canvas. */
void canvas_draw_image(struct canvas *canvas, uint32_t x, uint32_t y, const struct canvas *source);

/* Draws light ASCII text with its top left corner at (x, y), magnified by the integer `scale`. */
void canvas_draw_text(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t scale,
                      const char *text);

#endif
