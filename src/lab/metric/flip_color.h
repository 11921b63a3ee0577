/*
 * flip_color.h: colour spaces and colour distance of FLIP. The white point is D65. Linear colours
 * have Rec.709 primaries. See sections 4.1.1 to 4.1.3 of Andersson, Nilsson, Akenine-Moeller,
 * Oskarsson, Astroem, Fairchild: FLIP: A Difference Evaluator for Alternating Images. HPG 2020.
 */
#ifndef FIRN_LAB_METRIC_FLIP_COLOR_H
#define FIRN_LAB_METRIC_FLIP_COLOR_H

#include <cglm/types-struct.h>

/* Converts linear colours to the opponent space YCxCz; Y ranges from -16 to 100. */
vec3s flip_color_opponent(vec3s linear);

/* Converts YCxCz to linear colours, without clamping. */
vec3s flip_color_linear(vec3s opponent);

/* Converts the Y of YCxCz to relative luminance, 0 to 1 (white). */
float flip_color_luminance(float y);

/* Converts linear colours to L*a*b* with Hunt's adjustment: chroma is scaled by lightness. */
vec3s flip_color_hunt(vec3s linear);

/* Returns the HyAB distance of two colours from flip_color_hunt(). */
float flip_color_distance(vec3s a, vec3s b);

/* Maps a colour distance to an error of 0 to 1. The distance of green and blue has error 1. */
float flip_color_error(float distance);

#endif
