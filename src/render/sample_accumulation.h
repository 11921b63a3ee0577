/* sample_accumulation.h: sums the samples that are read back from the device into float image
 * planes. */
#ifndef FIRN_RENDER_SAMPLE_ACCUMULATION_H
#define FIRN_RENDER_SAMPLE_ACCUMULATION_H

#include "src/base/status.h"
#include "src/base/tile.h"
#include "src/file/image.h"
#include "src/render/frame/output_layers.h"

/* Adds zero-filled planes for a layer to the image. Returns false when out of memory. */
bool accumulate_add_planes(struct image *image, const struct frame_layer *layer);

/* Adds one sample of a layer to a rectangle of the image's planes. `texels` is the layer's image as
 * read back, without row padding. Layers that are not averaged (IDs, depth) use only sample 0,
 * because it is at the pixel centre. */
void accumulate_sample(struct image *image, const struct tile *tile,
                       const struct frame_layer *layer, const void *texels, uint32_t sample);

/* Divides the sums in an averaged layer's planes by the number of samples. */
void accumulate_mean(struct image *image, const struct frame_layer *layer, uint32_t samples);

#endif
