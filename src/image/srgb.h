/* srgb.h: the encoding of colours for displays. */
#ifndef FIRN_IMAGE_SRGB_H
#define FIRN_IMAGE_SRGB_H

/* From 0 to 1 to linear light, IEC 61966-2-1. */
float srgb_decode(float encoded);

#endif
