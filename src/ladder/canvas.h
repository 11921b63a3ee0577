/* canvas.h: an RGBA image with functions to draw boxes, images and text. */
#ifndef FIRN_LADDER_CANVAS_H
#define FIRN_LADDER_CANVAS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    CANVAS_TEXT_HEIGHT = 12 /* line height in pixels at scale 1 */
};

struct canvas {
    uint32_t width, height; /* pixels */
    uint8_t *rgba;          /* sRGB-encoded, rows from top to bottom, opaque */
};

/* Allocates a canvas filled with a grey, which the caller frees. Returns false when out of memory.
 */
bool canvas_init(struct canvas *canvas, uint32_t width, uint32_t height, uint8_t grey);

/* Draw a filled box, or an image with its top left corner at (x, y). `box` is left, top, width and
 * height in pixels. All drawing is clipped to the canvas. */
void canvas_fill(struct canvas *canvas, const uint32_t box[static 4], const uint8_t rgb[static 3]);
void canvas_draw_image(struct canvas *canvas, uint32_t x, uint32_t y, const struct canvas *picture);

/* Draws light ASCII text at (x, y), its top left corner; each font pixel is scale * scale pixels.
 */
void canvas_draw_text(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t scale,
                      const char *text);

#endif
