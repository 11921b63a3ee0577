/* aov_to_png.h: converts layers (AOVs) to displayable images, for --show. Pixels without a
 * value (0; for Z, 1e10) are black. Amounts and distances are grey, linear in the 8-bit value: from
 * 1/8 for the minimum to white for the maximum of the image; the nearest distance is white.
 * Directions are shown as 0.5 + 0.5 v; each axis of positions is scaled to its range. Colours are
 * sRGB-encoded, premultiplied ones over black. */
#ifndef FIRN_SETUP_AOV_TO_PNG_H
#define FIRN_SETUP_AOV_TO_PNG_H

#include "src/file/image.h"
#include "src/render/frame/output_layers.h"

/* Returns the layer called `name`, or NULL. Logs nothing. */
const struct frame_layer *layer_image_find(const char *name);

/* Returns the layer's bit in renderer_params.layers, or 0 for NULL. */
uint32_t layer_image_bit(const struct frame_layer *layer);

/* Return RGBA pixels of a layer with 8 or 16 bits per channel. The caller frees them. `image` must
 * have the layer's planes. If out of memory, log an error and return NULL. */
uint8_t *layer_image_rgba(const struct image *image, const struct frame_layer *layer);
uint16_t *layer_image_rgba_16(const struct image *image, const struct frame_layer *layer);

/* Tone-maps the layer `beauty` to `rgba` and `rgba_16`, either of which may be NULL. If
 * tonemap.dither is on, dithers `rgba`. If out of memory, logs an error and returns false. */
bool layer_image_beauty(const struct image *image, const struct settings *settings, uint8_t **rgba,
                        uint16_t **rgba_16);

bool layer_image_is_dithered(const struct settings *settings);

#endif
