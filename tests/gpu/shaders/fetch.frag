/* fetch.frag: the texel behind, plus a colour. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/paint.h"

layout(binding = PAINT_SOURCE) uniform sampler2D source;
layout(location = 0) out vec4 color;

layout(push_constant, scalar) uniform Push
{
    paint_push push;
};

void main()
{
    color = texelFetch(source, ivec2(gl_FragCoord.xy), 0) + push.color;
}
