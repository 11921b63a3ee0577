/* cracks_clip.glsl: crack_is_inside(), which clips cracks to the ice. CRACKS_CONVEX clips at the
 * nearest front face. CRACKS_BEFORE_BACK also clips at the farthest back face. CRACKS_INTERVAL
 * clips to the intervals of a pixel's ray inside the ice. CRACKS_UNCLIPPED does not clip. */
#include "inclusions/cracks.h"
#if defined CRACKS_CONVEX

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
#elif defined CRACKS_INTERVAL
#include "ice/ice_interval.glsl"

layout(set = 0, binding = CRACKS_NEAR) uniform sampler2DArray near;
layout(set = 0, binding = CRACKS_FAR) uniform sampler2DArray far;

bool crack_is_inside()
{
    return ice_interval_contains(near, far, gl_FragCoord.z);
}
#else
bool crack_is_inside()
{
    return true;
}
#endif
