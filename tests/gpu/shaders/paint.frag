/* paint.frag: one colour. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/paint.h"

layout(location = 0) out vec4 color;

layout(push_constant, scalar) uniform Push
{
    paint_push push;
};

void main()
{
    color = push.color;
}
