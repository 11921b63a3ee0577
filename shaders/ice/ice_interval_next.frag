#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice/ice_interval.glsl"

layout(set = 0, binding = ICE_INTERVAL_BEFORE) uniform sampler2DArray before;

/* Discards faces not behind the previous layer; the depth test keeps the nearest of the others. */
void main()
{
    float layer = ice_interval_layer(gl_FragCoord.z, gl_FrontFacing);
    if (layer <= texelFetch(before, ivec3(gl_FragCoord.xy, 0), 0).r)
        discard;
    gl_FragDepth = layer;
}
