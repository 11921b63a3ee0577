/*
 * accumulate.h: adds up the samples that are read back from the device in planes of floats.
 */
#ifndef FIRN_RENDER_ACCUMULATE_H
#define FIRN_RENDER_ACCUMULATE_H

#include "src/base/status.h"
#include "src/base/tile.h"
#include "src/frame/layers.h"
#include "src/image/image.h"

/* Adds the planes of a layer, filled with 0, to an image. Returns false when out of memory. */
bool accumulate_add_planes(struct image *image, const struct frame_layer *layer);

/*
 * Adds one sample of a layer to its planes, in a part of the image. `texels` are those of the
 * layer's image, rows tight. Layers that are not averaged use sample 0, the pixel's centre, alone.
 */
void accumulate_sample(struct image *image, const struct tile *part,
                       const struct frame_layer *layer, const void *texels, uint32_t sample);

/* Divides an averaged layer's planes by the number of samples. */
void accumulate_mean(struct image *image, const struct frame_layer *layer, uint32_t samples);

#endif
