/* caustics_reduce.comp: compute shader that sums the light map by a reduction in one workgroup. */
#version 460
#include "water/caustics.h"

layout(local_size_x = CAUSTICS_GROUP_1D) in;
layout(set = 0, binding = CAUSTICS_RAW) uniform sampler2D raw;

layout(set = 0, binding = CAUSTICS_SUM, scalar) writeonly buffer Sum
{
    float total;
};

shared float sums[CAUSTICS_GROUP_1D];

void main()
{
    uint i = gl_LocalInvocationID.x;
    float sum = 0.0;
    for (int x = int(i); x < CAUSTICS_SIZE; x += CAUSTICS_GROUP_1D) {
        for (int y = 0; y < CAUSTICS_SIZE; y++)
            sum += texelFetch(raw, ivec2(x, y), 0).r;
    }
    sums[i] = sum;
    for (uint half_ = CAUSTICS_GROUP_1D / 2; half_ > 0u; half_ /= 2u) {
        barrier();
        if (i < half_)
            sums[i] += sums[i + half_];
    }
    if (i == 0u)
        total = sums[0];
}
