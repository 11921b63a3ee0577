/* ice_caustics_clear.comp: compute shader that clears the photon counts of ice caustics. */
#version 460
#include "lighting/ice_caustics.h"

layout(local_size_x = ICE_CAUSTICS_GROUP, local_size_y = ICE_CAUSTICS_GROUP) in;
layout(set = 0, binding = ICE_CAUSTICS_COUNTS, r32ui) uniform writeonly uimage2D counts;

void main()
{
    imageStore(counts, ivec2(gl_GlobalInvocationID.xy), uvec4(0u));
}
