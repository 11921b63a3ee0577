/* ice_interval_first.frag: fragment shader of the depth peeling of the ice's faces, first layer. */
#version 460
#include "ice/ice_interval.glsl"

void main()
{
    gl_FragDepth = ice_interval_layer(gl_FragCoord.z, gl_FrontFacing);
}
