/* caustics_clear.comp: compute shader that clears the photon counts of pool caustics. */
#version 460
#include "water/caustics.h"

layout(local_size_x = CAUSTICS_GROUP_2D, local_size_y = CAUSTICS_GROUP_2D) in;
layout(set = 0, binding = CAUSTICS_COUNTS, r32ui) uniform writeonly uimage2D counts;

void main()
{
    imageStore(counts, ivec2(gl_GlobalInvocationID.xy), uvec4(0u));
}
