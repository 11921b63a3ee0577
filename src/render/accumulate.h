/*
 * accumulate.h: what comes back from the device, sample by sample, becomes planes of floats.
 */
#ifndef FIRN_RENDER_ACCUMULATE_H
#define FIRN_RENDER_ACCUMULATE_H

#include <cglm/struct.h>
#include "src/base/status.h"
#include "src/frame/layers.h"
#include "src/image/image.h"

/* Adds the planes of a layer to an image, all 0. False when memory is short. */
bool accumulate_add_planes(struct image *image, const struct frame_layer *layer);

/*
 * Adds one sample of a layer to its planes. `texels` are those of the layer's image, rows tight.
 * Layers that are not averaged take sample 0, the pixel's centre, and ignore the others.
 */
void accumulate_sample(struct image *image, const struct frame_layer *layer, const void *texels,
                       uint32_t sample);

/* Divides an averaged layer's planes by the number of samples. */
void accumulate_mean(struct image *image, const struct frame_layer *layer, uint32_t samples);

/*
 * Where in its pixel sample i lies, in pixels from the pixel's centre, in [-0.5, 0.5). Sample 0 is
 * the centre; the others follow Roberts' R2 sequence, which fills the pixel evenly at any count.
 */
vec2s accumulate_jitter(uint32_t sample);

#endif
