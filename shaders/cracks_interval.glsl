/* cracks_interval.glsl: inside is what lies within one of the pixel's intervals. */
#include "cracks.h"
#include "ice_interval.glsl"

layout(set = 0, binding = CRACKS_INTERVALS) uniform sampler2DArray layers;

bool crack_is_inside()
{
    return ice_interval_contains(layers, gl_FragCoord.z);
}
