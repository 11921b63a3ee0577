/* paint_two.frag: a colour and its mirror image. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/paint.h"

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 mirrored;

layout(push_constant, scalar) uniform Push
{
    paint_push push;
};

void main()
{
    color = push.color;
    mirrored = push.color.abgr;
}
