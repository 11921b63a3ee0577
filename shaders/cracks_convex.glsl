/* cracks_convex.glsl: clips cracks between the nearest front face and the farthest back face. The
 * depth test rejects fragments behind the latter, or this code does with CRACKS_BEFORE_BACK. */
#include "cracks.h"

layout(set = 0, binding = CRACKS_FRONT) uniform sampler2D front;
#ifdef CRACKS_BEFORE_BACK
layout(set = 0, binding = CRACKS_BACK) uniform sampler2D back;
#endif

bool crack_is_inside()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = gl_FragCoord.z;
#ifdef CRACKS_BEFORE_BACK
    if (depth > texelFetch(back, pixel, 0).r)
        return false;
#endif
    return texelFetch(front, pixel, 0).r <= depth;
}
