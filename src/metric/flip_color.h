/*
 * flip_color.h: the colours of FLIP and how far apart they are.
 *
 * Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild: FLIP: A Difference Evaluator
 * for Alternating Images. HPG 2020: sections 4.1.1 (opponent colours), 4.1.2 (uniform ones and
 * their distance) and 4.1.3 (errors). White is D65, and linear colours are of Rec.709.
 */
#ifndef FIRN_METRIC_FLIP_COLOR_H
#define FIRN_METRIC_FLIP_COLOR_H

#include <cglm/struct.h>

/* From linear colours to Y, Cx, Cz: -16 to 100 of Y. */
vec3s flip_color_opponent(vec3s linear);

/* And back, without limits. */
vec3s flip_color_linear(vec3s opponent);

/* What Y is of white, from 0 to 1. */
float flip_color_luminance(float y);

/* From linear colours to L*a*b*, whose a* and b* fade with L* (Hunt). */
vec3s flip_color_hunt(vec3s linear);

/* HyAB, of what flip_color_hunt() gives. */
float flip_color_distance(vec3s a, vec3s b);

/* From a distance to an error from 0 to 1, which is that of green and blue. */
float flip_color_error(float distance);

#endif
