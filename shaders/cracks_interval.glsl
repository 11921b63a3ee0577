/* cracks_interval.glsl: a point is inside if it is within one of the pixel's intervals. */
#include "cracks.h"
#include "ice_interval.glsl"

layout(set = 0, binding = CRACKS_NEAR) uniform sampler2DArray near;
layout(set = 0, binding = CRACKS_FAR) uniform sampler2DArray far;

bool crack_is_inside()
{
    return ice_interval_contains(near, far, gl_FragCoord.z);
}
