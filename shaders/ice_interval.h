/* ice_interval.h: what ice_interval.c, its shaders and their readers agree on. */
#ifndef SHADERS_ICE_INTERVAL_H
#define SHADERS_ICE_INTERVAL_H

#define ICE_INTERVAL_BEFORE 1 /* bindings: the layer before */
#define ICE_INTERVAL_NEAR   1 /* the nearer half of the layers */
#define ICE_INTERVAL_FAR    2 /* the others */
#define ICE_INTERVAL_MAX    8 /* intervals of a pixel, at most */

#endif
