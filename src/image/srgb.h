/* srgb.h: transfer function of sRGB. */
#ifndef FIRN_IMAGE_SRGB_H
#define FIRN_IMAGE_SRGB_H

/* Returns the linear value, 0 to 1, of an sRGB-encoded value, 0 to 1 (IEC 61966-2-1). */
float srgb_decode(float encoded);
float srgb_encode(float linear); /* inverse of srgb_decode(); clamps to 0 to 1 */

#endif
