#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice_interval.glsl"

layout(set = 0, binding = ICE_INTERVAL_LAYERS) uniform sampler2DArray layers;

layout(location = 0) out float count;

void main()
{
    count = float(ice_interval_count(layers));
}
