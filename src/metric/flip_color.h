/*
 * flip_color.h: the colours of FLIP and how far apart they are.
 *
 * Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild: FLIP: A Difference Evaluator
 * for Alternating Images. HPG 2020: sections 4.1.1 (opponent colours), 4.1.2 (uniform ones and
 * their distance) and 4.1.3 (errors). White is D65, and linear colours are of Rec.709.
 */
#ifndef FIRN_METRIC_FLIP_COLOR_H
#define FIRN_METRIC_FLIP_COLOR_H

#include <cglm/types-struct.h>

/* Converts linear colours to YCxCz; Y is from -16 to 100. */
vec3s flip_color_opponent(vec3s linear);

/* Converts YCxCz to linear colours, without clamping. */
vec3s flip_color_linear(vec3s opponent);

/* Converts Y to luminance, from 0 to 1 for white. */
float flip_color_luminance(float y);

/* Converts linear colours to L*a*b* with Hunt's adjustment, which scales a* and b* by L*. */
vec3s flip_color_hunt(vec3s linear);

/* Returns the HyAB distance of two colours of flip_color_hunt(). */
float flip_color_distance(vec3s a, vec3s b);

/* Maps a distance to an error from 0 to 1, the distance of green and blue. */
float flip_color_error(float distance);

#endif
