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
uint64_t layer_image_bit(const struct frame_layer *layer);

struct ocio_view;

/* Converts a layer, or the tone-mapped beauty if `layer` is NULL, to RGBA pixels: *rgba has 8 bits
 * per channel, *rgba_16 has 16; either may be NULL. The caller frees them. `image` must have the
 * layer's planes. If `view` is not NULL, it replaces the tone curve. If tonemap.dither is on,
 * dithers the beauty in *rgba. If out of memory, logs an error and returns false. */
bool layer_image_show(const struct image *image, const struct frame_layer *layer,
                      const struct settings *settings, const struct ocio_view *view, uint8_t **rgba,
                      uint16_t **rgba_16);

bool layer_image_is_dithered(const struct settings *settings);

#endif
