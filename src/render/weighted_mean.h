/*
 * weighted_mean.h: luminance-weighted mean of a pixel's samples, for PNG files and windows.
 *
 * A tone curve maps all radiance far above white to white. A linear mean before the curve therefore
 * turns the edge of a highlight into a stair: one bright sample makes a whole pixel white. Bright
 * samples get smaller weights, 1 / (1 + scale * luminance) (Karis 2014, High Quality Temporal
 * Supersampling), so that the pixel is between both sides of the edge after the curve. The weighted
 * mean is the linear mean where the samples of a pixel agree, and darker elsewhere.
 *
 * A reconstruction filter that is wider than a pixel suppresses single bright pixels, which remain
 * where light paths scatter widely. After it, pixels with a high standard error are denoised by
 * non-local means with patches of one pixel: neighbours count if they differ no more than the noise
 * explains (Rousselle, Knaus and Zwicker 2012, Adaptive Rendering with Non-Local Means Filtering).
 * The more samples, the fewer pixels are denoised.
 *
 * Alpha is not weighted, because it is the coverage of the pixel. The radiance of samples is
 * premultiplied by alpha; its weights depend on the luminance without alpha.
 */
#ifndef FIRN_RENDER_WEIGHTED_MEAN_H
#define FIRN_RENDER_WEIGHTED_MEAN_H

#include "src/base/tile.h"
#include "src/file/image.h"
#include "src/render/frame/output_layers.h"
#include "src/settings/settings.h"

/* The planes besides those of frame_beauty in an image of weighted sums. */
extern const struct frame_layer weighted_mean_extra;

/* Returns the scale of the weights: the gain of the exposure, so that they depend on displayed
 * luminance. Returns 0, for equal weights, if the setting tonemap.resolve is `linear`. */
float weighted_mean_scale(const struct settings *settings);

/* Returns true if the mean is also filtered: weighted_mean_filter(). */
bool weighted_mean_is_filtered(const struct settings *settings);

/* Returns a sample's weight. `scale` is weighted_mean_scale(). */
float weighted_mean_weight(const float rgba[static 4], float scale);

/* Returns the factor from a sum of weighted radiance to the mean. `alpha` is the sum of alpha,
 * `weight` that of weights times alpha. */
double weighted_mean_factor(double alpha, double weight, uint32_t samples);

/* Adds zero-filled planes for weighted sums of frame_beauty: R, G, B, A, the sum of weights, and
 * `variance`, which holds the sum of brightness while samples accumulate. Returns false when out of
 * memory. */
bool weighted_mean_add_planes(struct image *sums);

/* Adds one sample to a rectangle of the sums. `texels` are RGBA half floats without row padding. */
void weighted_mean_add(struct image *sums, const struct tile *tile, const uint16_t *texels,
                       float scale);

/* Writes pixel `i`: the mean over `samples` samples and the variance of the mean brightness. The
 * destination `mean` has the planes of `sums`, and may be `sums`. Brightness is the square root
 * of displayed luminance, 0 to 1; its variance is 0 for one sample. `scale` is that of
 * weighted_mean_add(). */
void weighted_mean_pixel(const struct image *sums, size_t i, uint32_t samples, float scale,
                         struct image *mean);

/* Replaces the sums of all pixels by the means. */
void weighted_mean_divide(struct image *sums, uint32_t samples, float scale);

/*
 * Applies a reconstruction filter to a whole image, so that each sample also contributes to
 * neighbouring pixels. The mean weight of a pixel's samples is the weight of their mean, so that
 * the samples are not needed. Then denoises the image, if it has the plane `variance`. Returns
 * false when out of memory.
 */
MUST_USE bool weighted_mean_filter(struct image *mean, float scale);
MUST_USE bool weighted_mean_reconstruct(struct image *mean, float scale); /* the first half */
MUST_USE bool weighted_mean_denoise(struct image *mean, float scale);     /* the second half */

#endif
