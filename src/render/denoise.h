/*
 * denoise.h: denoises the lighting of surroundings that were traced with few rays.
 *
 * Edge-avoiding A-Trous filter with growing step width (Dammertz, Sewtz, Hanika and Lensch 2010,
 * Edge-avoiding A-Trous wavelet transform for fast global illumination filtering). Its weights fall
 * with the difference of local mean brightness relative to its noise (as in Schied et al. 2017,
 * Spatiotemporal variance-guided filtering). The filter works on irradiance without albedo, so
 * textures stay sharp. Positions are those of the surface hit behind refracting water drops, so
 * pixels of different drops share samples, too.
 */
#ifndef FIRN_RENDER_DENOISE_H
#define FIRN_RENDER_DENOISE_H

#include <stdbool.h>
#include "src/file/image.h"

enum {
    DENOISE_SAMPLES_ENOUGH = 32 /* samples per pixel from which images are not denoised */
};

/* Adds the denoised lighting to the planes R, G and B of two images, if present. `ground` must have
 * the averaged planes of frame_denoise_layers (src/tech/frame_resources.h). Its plane "samples"
 * must hold each pixel's sample count. If out of memory, returns false. */
bool denoise_light(struct image *image, struct image *display, const struct image *ground);

#endif
