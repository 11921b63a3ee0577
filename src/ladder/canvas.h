/* canvas.h: an image into which pictures and text are drawn. */
#ifndef FIRN_LADDER_CANVAS_H
#define FIRN_LADDER_CANVAS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    CANVAS_TEXT_HEIGHT = 12 /* height of a line of text at scale 1, pixels */
};

struct canvas {
    uint32_t width, height; /* pixels */
    uint8_t *rgba;          /* sRGB, rows from the top; opaque */
};

/* Makes a canvas filled with a grey. Returns false when out of memory. The caller frees
 * canvas->rgba. */
bool canvas_init(struct canvas *canvas, uint32_t width, uint32_t height, uint8_t grey);

/* Fills a box, or copies a picture to (x, y). `box` is left, top, width, height, in pixels. All
 * drawing is clipped to the canvas. */
void canvas_fill(struct canvas *canvas, const uint32_t box[static 4], const uint8_t rgb[static 3]);
void canvas_put(struct canvas *canvas, uint32_t x, uint32_t y, const struct canvas *picture);

/* Draws light ASCII text whose top left corner is (x, y); every pixel of the font becomes a square
 * of scale x scale pixels. */
void canvas_write(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t scale, const char *text);

#endif
