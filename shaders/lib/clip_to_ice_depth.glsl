/* clip_to_ice_depth.glsl: clips fragments to the ice (Seipel and Nivfors 2006, 3.3). Per pixel, the
 * ice lies between its nearest front face and its farthest back face. Render targets must have the
 * size of the depth maps. */
#ifndef CLIP_TO_ICE_DEPTH_GLSL
#define CLIP_TO_ICE_DEPTH_GLSL
#include "ice/ice_depth.h"

layout(set = 0, binding = ICE_DEPTH_FRONT) uniform sampler2D ice_clip_front;
layout(set = 0, binding = ICE_DEPTH_BACK) uniform sampler2D ice_clip_back;

/* Returns true if a depth-buffer value of globals.fitted_clip_from_world is inside the ice. */
bool ice_clip_keeps(float depth)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    return depth >= texelFetch(ice_clip_front, pixel, 0).r &&
           depth <= texelFetch(ice_clip_back, pixel, 0).r;
}

#endif
