/* ice_interval.h: what ice_interval.c, its shaders and their readers agree on. */
#ifndef SHADERS_ICE_INTERVAL_H
#define SHADERS_ICE_INTERVAL_H

#define ICE_INTERVAL_LAYERS 1 /* binding: the layers, or the one before */
#define ICE_INTERVAL_MAX    8 /* intervals of a pixel, at most */

#endif
