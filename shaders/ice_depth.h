/* ice_depth.h: bindings of shaders that read ice_depth's images; some read refract.h's, too. */
#ifndef SHADERS_ICE_DEPTH_H
#define SHADERS_ICE_DEPTH_H

#define ICE_DEPTH_FRONT 22
#define ICE_DEPTH_BACK  23

#endif
