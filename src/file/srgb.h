/* srgb.h: transfer function of sRGB. */
#ifndef FIRN_FILE_SRGB_H
#define FIRN_FILE_SRGB_H

/* Converts an sRGB-encoded value of 0..1 to a linear value of 0..1 (IEC 61966-2-1). */
float srgb_decode(float encoded);
float srgb_encode(float linear); /* inverse; clamps its result to 0..1 */

#endif
