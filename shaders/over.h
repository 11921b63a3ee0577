/* over.h: shared by over.c, over.{vert,frag}, target_scale.c and over_whole.frag. */
#ifndef SHADERS_OVER_H
#define SHADERS_OVER_H
#include "abi.h"

#define OVER_HIGHLIGHT   1 /* surface_highlight: below 0 in pixels without ice */
#define OVER_AIR         2
#define OVER_BUBBLES     3
#define OVER_CRACKS      4
#define OVER_ENVIRONMENT 5 /* equirectangular picture */

/* With BUBBLES_BENT: of the front faces, and of bubbles (within.glsl). */
#define OVER_FRONT_DEPTH  6
#define OVER_SHADING      7
#define OVER_BUBBLE_DEPTH 8

#define OVER_BEND 1 /* location of what over.vert passes to over_bend.glsl: 1 to 8 */

#define OVER_SMALL 1 /* the image that over_whole.frag enlarges */

/* CONSTANT_OVER: a bit for each image to blend; IS_SMALL: those but highlights are smaller than the
 * picture. */
#define OVER_HAS_HIGHLIGHT (1u << OVER_HIGHLIGHT)
#define OVER_HAS_AIR       (1u << OVER_AIR)
#define OVER_HAS_BUBBLES   (1u << OVER_BUBBLES)
#define OVER_HAS_CRACKS    (1u << OVER_CRACKS)
#define OVER_IS_SMALL      (1u << 5)

#endif
