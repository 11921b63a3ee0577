/* ice_interval_next.frag: fragment shader that peels the next depth layer of the ice's faces. */
#version 460
#include "ice/ice_interval.glsl"

layout(set = 0, binding = ICE_INTERVAL_BEFORE) uniform sampler2DArray previous;

/* Discards faces up to the previous layer. The depth test keeps the nearest remaining face. */
void main()
{
    float layer = ice_interval_layer(gl_FragCoord.z, gl_FrontFacing);
    if (layer <= texelFetch(previous, ivec3(gl_FragCoord.xy, 0), 0).r)
        discard;
    gl_FragDepth = layer;
}
