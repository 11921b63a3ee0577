/* halve.frag: the mean of four texels; at the edge of an odd image, the last one again. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/paint.h"

layout(binding = PAINT_SOURCE) uniform sampler2D source;
layout(location = 0) out vec4 color;

void main()
{
    ivec2 corner = ivec2(gl_FragCoord.xy) * 2;
    ivec2 last = textureSize(source, 0) - 1;
    color = vec4(0);
    for (int i = 0; i < 4; i++)
        color += texelFetch(source, min(corner + ivec2(i & 1, i >> 1), last), 0) * 0.25;
}
