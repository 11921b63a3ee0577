/* fetch_samples.frag: a texel's four samples, once the first, twice the second ... added up. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/paint.h"

layout(binding = PAINT_SOURCE) uniform sampler2DMS source;
layout(location = 0) out vec4 color;

void main()
{
    color = vec4(0);
    for (int i = 0; i < 4; i++)
        color += texelFetch(source, ivec2(gl_FragCoord.xy), i) * float(i + 1);
}
