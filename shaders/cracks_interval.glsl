/* cracks_interval.glsl: clips cracks to the intervals in which a pixel's ray is inside the ice. */
#include "cracks.h"
#include "ice_interval.glsl"

layout(set = 0, binding = CRACKS_NEAR) uniform sampler2DArray near;
layout(set = 0, binding = CRACKS_FAR) uniform sampler2DArray far;

bool crack_is_inside()
{
    return ice_interval_contains(near, far, gl_FragCoord.z);
}
