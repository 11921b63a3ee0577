/* timestamp_check.comp: compute shader of a test load for src/lab/profile/timestamp_check.c. */
#version 460
#include "lib/gpu_busy_loop.glsl"
#include "output/timestamp_check.h"

layout(local_size_x = TIMESTAMP_CHECK_GROUP) in;

layout(push_constant, scalar) uniform Push
{
    timestamp_check_push push;
};

layout(set = 0, binding = TIMESTAMP_CHECK_NUMBERS, scalar) writeonly buffer Numbers
{
    float numbers[];
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    numbers[i] = busy(fract(float(i) * 0.37) + 0.01, push.rounds);
}
