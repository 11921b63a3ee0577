/* over.h: bindings of the compositing of inclusions, over*.{vert,frag} and target_scale.c. */
#ifndef SHADERS_OVER_H
#define SHADERS_OVER_H
#include "abi.h"

#define OVER_HIGHLIGHT   1 /* surface_highlight: negative in pixels without ice */
#define OVER_AIR         2
#define OVER_BUBBLES     3
#define OVER_CRACKS      4
#define OVER_ENVIRONMENT 5 /* equirectangular environment map */

/* With BUBBLES_BENT: front faces' depth and normal, bubbles' depth (within.glsl). */
#define OVER_FRONT_DEPTH  6
#define OVER_SHADING      7
#define OVER_BUBBLE_DEPTH 8

#define OVER_BEND 1 /* first of the locations 1 to 8 that over.vert passes to over_bend.glsl */

#define OVER_SMALL 1 /* low-resolution image that over_whole.frag upsamples */

/* CONSTANT_OVER: a bit for each image to composite. IS_SMALL: all but the highlights have a lower
 * resolution than the final image. */
#define OVER_HAS_HIGHLIGHT (1u << OVER_HIGHLIGHT)
#define OVER_HAS_AIR       (1u << OVER_AIR)
#define OVER_HAS_BUBBLES   (1u << OVER_BUBBLES)
#define OVER_HAS_CRACKS    (1u << OVER_CRACKS)
#define OVER_IS_SMALL      (1u << 5)

#endif
