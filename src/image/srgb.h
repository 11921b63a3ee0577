/* srgb.h: the transfer function of sRGB. */
#ifndef FIRN_IMAGE_SRGB_H
#define FIRN_IMAGE_SRGB_H

/* Returns the linear value, 0 to 1, of an encoded one, 0 to 1 (IEC 61966-2-1). */
float srgb_decode(float encoded);
float srgb_encode(float linear); /* the inverse; beyond 0 and 1 it is clamped */

#endif
