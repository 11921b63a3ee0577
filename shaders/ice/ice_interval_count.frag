/* ice_interval_count.frag: fragment shader that counts a primary ray's intervals inside the ice. */
#version 460
#include "ice/ice_interval.glsl"

layout(set = 0, binding = ICE_INTERVAL_NEAR) uniform sampler2DArray near;
layout(set = 0, binding = ICE_INTERVAL_FAR) uniform sampler2DArray far;

layout(location = 0) out float count;

void main()
{
    count = float(ice_interval_count(near, far));
    if (count == 0.0)
        discard;
}
