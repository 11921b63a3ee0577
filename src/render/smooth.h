/*
 * smooth.h: light that few rays bring to surroundings, as its mean over pixels of the same surface.
 *
 * A filter of few steps of growing width (Dammertz, Sewtz, Hanika and Lensch 2010, Edge-avoiding
 * A-Trous wavelet transform for fast global illumination filtering), whose weights fall with the
 * difference of the light around, beside its noise (as in Schied et al. 2017, Spatiotemporal
 * variance-guided filtering). What is filtered is the light on a surface without the surface's
 * colours, which stay as sharp as they are. It is known where each pixel sees the surface, so
 * pixels of different drops of water before it count for each other, too.
 */
#ifndef FIRN_RENDER_SMOOTH_H
#define FIRN_RENDER_SMOOTH_H

#include <stdbool.h>
#include "src/image/image.h"

enum {
    SMOOTH_ENOUGH = 32 /* samples that need no filter */
};

/*
 * Adds smoothed light to the planes R, G and B of a picture, if it has them. `ground` has the
 * planes of frame_smooth_layers (src/tech/frame.h), means of the samples, and "samples", of each
 * pixel. Returns false when out of memory.
 */
bool smooth_light(struct image *picture, const struct image *ground);

#endif
