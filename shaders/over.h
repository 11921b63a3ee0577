/* over.h: what over.c and over.{vert,frag} agree on. */
#ifndef SHADERS_OVER_H
#define SHADERS_OVER_H
#include "abi.h"

#define OVER_HIGHLIGHT   1 /* what the rung's row left: below 0 where it drew nothing */
#define OVER_AIR         2
#define OVER_BUBBLES     3
#define OVER_CRACKS      4
#define OVER_ENVIRONMENT 5 /* equirectangular picture */

/* CONSTANT_OVER: which of them count, a bit each */
#define OVER_HAS_HIGHLIGHT (1u << OVER_HIGHLIGHT)
#define OVER_HAS_AIR       (1u << OVER_AIR)
#define OVER_HAS_BUBBLES   (1u << OVER_BUBBLES)
#define OVER_HAS_CRACKS    (1u << OVER_CRACKS)

#endif
