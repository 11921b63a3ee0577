/*
 * layer_picture.h: a layer as a picture for people's eyes, for --show.
 *
 * Where a layer has nothing (0; of Z, 1e10) it is black. Amounts and distances are grey, linear in
 * the 8-bit value: from 1/8 to white between the least and the greatest of the picture, the nearest
 * distance white. Directions are 0.5 + 0.5 v; of positions, each axis is stretched from its least
 * to its greatest. Colours are sRGB-encoded, premultiplied ones over black.
 */
#ifndef FIRN_APP_LAYER_PICTURE_H
#define FIRN_APP_LAYER_PICTURE_H

#include "src/frame/layers.h"
#include "src/image/image.h"

/* The layer of that name, or NULL; logs nothing. */
const struct frame_layer *layer_picture_find(const char *name);

/* Bit i of renderer_params.layers for techniques_layer(i); 0 for NULL. */
uint32_t layer_picture_bit(const struct frame_layer *layer);

/* width * height * 4 values, as png_picture.rgba and png_picture.rgba_16; NULL when memory is
 * short, which is logged. The caller frees them. The image has the layer's planes. */
uint8_t *layer_picture_rgba(const struct image *image, const struct frame_layer *layer);
uint16_t *layer_picture_rgba_16(const struct image *image, const struct frame_layer *layer);

/* The same of the beauty, tonemapped as the settings say, with its alpha: either of 8 bits, with
 * dither if it is on, or of 16; the other pointer is NULL. Returns false when memory is short,
 * which is logged. */
bool layer_picture_beauty(const struct image *image, const struct settings *settings,
                          uint8_t **rgba, uint16_t **rgba_16);

/* Returns whether tonemap.dither is on. */
bool layer_picture_is_dithered(const struct settings *settings);

#endif
