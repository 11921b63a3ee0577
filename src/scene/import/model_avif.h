/* model_avif.h: decodes AVIF textures of models, by libavif. */
#ifndef FIRN_SCENE_IMPORT_MODEL_AVIF_H
#define FIRN_SCENE_IMPORT_MODEL_AVIF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/base/status.h"

/* Returns true if this build decodes AVIF. */
bool model_avif_is_built(void);

/* Reads the size of an image from its header. Returns false if it is no AVIF image, or damaged. */
bool model_avif_read_size(const uint8_t *bytes, size_t size, int *width, int *height);

/* Decodes an image to width x height RGBA texels of 8 bits with straight alpha. Returns STATUS_DATA
 * if the image is damaged. */
MUST_USE enum status model_avif_decode(const uint8_t *bytes, size_t size, int width, int height,
                                       uint8_t *texels);

#endif
