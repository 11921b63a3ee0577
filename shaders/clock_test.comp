#version 460
#extension GL_GOOGLE_include_directive : require
#include "clock_test.h"
#include "lib/busy.glsl"

layout(local_size_x = CLOCK_TEST_GROUP) in;

layout(push_constant, scalar) uniform Push
{
    clock_test_push push;
};

layout(set = 0, binding = CLOCK_TEST_NUMBERS, scalar) writeonly buffer Numbers
{
    float numbers[];
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    numbers[i] = busy(fract(float(i) * 0.37) + 0.01, push.rounds);
}
