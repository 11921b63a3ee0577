/* ice_interval.h: shared by ice_interval.c, its shaders and readers of its images. */
#ifndef SHADERS_ICE_INTERVAL_H
#define SHADERS_ICE_INTERVAL_H

#define ICE_INTERVAL_BEFORE 1 /* binding of the layer before */
#define ICE_INTERVAL_NEAR   1 /* binding of the nearer half of the layers */
#define ICE_INTERVAL_FAR    2 /* binding of the farther half of the layers */
#define ICE_INTERVAL_MAX    8 /* greatest number of intervals of a pixel */

#endif
