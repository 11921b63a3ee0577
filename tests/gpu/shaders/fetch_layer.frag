/* fetch_layer.frag: the texel behind in the first layer that is bound, plus a colour. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/paint.h"

layout(binding = PAINT_SOURCE) uniform sampler2DArray source;
layout(location = 0) out vec4 color;

layout(push_constant, scalar) uniform Push
{
    paint_push push;
};

void main()
{
    color = texelFetch(source, ivec3(gl_FragCoord.xy, 0), 0) + push.color;
}
