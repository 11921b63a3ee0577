/* sample_zero.frag: the first channel as a number, into the first sample alone. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/paint.h"

layout(location = 0) out uint number;

layout(push_constant, scalar) uniform Push
{
    paint_push push;
};

void main()
{
    number = uint(push.color.x);
    gl_SampleMask[0] = 1;
}
