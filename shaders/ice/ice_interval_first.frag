#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice/ice_interval.glsl"

void main()
{
    gl_FragDepth = ice_interval_layer(gl_FragCoord.z, gl_FrontFacing);
}
