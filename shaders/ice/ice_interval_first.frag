/* ice_interval_first.frag: fragment shader that peels the first depth layer of the ice's faces. */
#version 460
#include "ice/ice_interval.glsl"

void main()
{
    gl_FragDepth = ice_interval_layer(gl_FragCoord.z, gl_FrontFacing);
}
