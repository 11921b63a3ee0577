/* cracks_convex.glsl: inside is between the nearest front and the farthest back face. */
#include "cracks.h"

layout(set = 0, binding = CRACKS_FRONT) uniform sampler2D front;
layout(set = 0, binding = CRACKS_BACK) uniform sampler2D back;

bool crack_is_inside()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = gl_FragCoord.z;
    return texelFetch(front, pixel, 0).r <= depth && depth <= texelFetch(back, pixel, 0).r;
}
