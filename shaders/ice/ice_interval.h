/* ice_interval.h: bindings of the depth-peeled layers of the ice. */
#ifndef SHADERS_ICE_ICE_INTERVAL_H
#define SHADERS_ICE_ICE_INTERVAL_H

#define ICE_INTERVAL_BEFORE 1 /* previous layer */
#define ICE_INTERVAL_NEAR   1 /* nearer half of the layers */
#define ICE_INTERVAL_FAR    2 /* farther half of the layers */
#define ICE_INTERVAL_MAX    8 /* maximum number of intervals per pixel */

#endif
