/* ice_depth.h: bindings of the ice's front and back depth maps. */
#ifndef SHADERS_ICE_ICE_DEPTH_H
#define SHADERS_ICE_ICE_DEPTH_H

#define ICE_DEPTH_FRONT 22
#define ICE_DEPTH_BACK  23

#endif
