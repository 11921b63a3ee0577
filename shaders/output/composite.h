/* composite.h: bindings of the compositing of inclusions (composite*, low_res_inclusions.c). */
#ifndef SHADERS_OUTPUT_COMPOSITE_H
#define SHADERS_OUTPUT_COMPOSITE_H
#include "abi.h"

#define COMPOSITE_HIGHLIGHT   1 /* highlight_radiance: negative in pixels without ice */
#define COMPOSITE_AIR         2
#define COMPOSITE_BUBBLES     3
#define COMPOSITE_CRACKS      4
#define COMPOSITE_ENVIRONMENT 5 /* equirectangular environment map */

/* low-resolution image that composite_upsample_inclusions.frag upsamples */
#define COMPOSITE_LOW_RES 1

/* Bits of CONSTANT_COMPOSITE: which images exist, and whether they have low resolution. */
#define COMPOSITE_HAS_HIGHLIGHT (1u << COMPOSITE_HIGHLIGHT)
#define COMPOSITE_HAS_AIR       (1u << COMPOSITE_AIR)
#define COMPOSITE_HAS_BUBBLES   (1u << COMPOSITE_BUBBLES)
#define COMPOSITE_HAS_CRACKS    (1u << COMPOSITE_CRACKS)
#define COMPOSITE_IS_LOW_RES    (1u << 5)

#endif
