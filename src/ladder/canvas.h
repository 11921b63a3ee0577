/* canvas.h: a picture to put pictures and words on. */
#ifndef FIRN_LADDER_CANVAS_H
#define FIRN_LADDER_CANVAS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    CANVAS_TEXT_HEIGHT = 12 /* pixels of a line of words of scale 1 */
};

struct canvas {
    uint32_t width, height; /* pixels */
    uint8_t *rgba;          /* sRGB, rows from the top; opaque */
};

/* Filled with a grey. False: memory is short. The caller frees canvas->rgba. */
bool canvas_init(struct canvas *canvas, uint32_t width, uint32_t height, uint8_t grey);

/* box: left, top, width, height. What lies beyond the edges is left out, as below. */
void canvas_fill(struct canvas *canvas, const uint32_t box[static 4], const uint8_t rgb[static 3]);
void canvas_put(struct canvas *canvas, uint32_t x, uint32_t y, const struct canvas *picture);

/* Light words, of ASCII, from their top left corner on; every pixel of the font becomes scale x
 * scale of them. */
void canvas_write(struct canvas *canvas, uint32_t x, uint32_t y, uint32_t scale, const char *text);

#endif
