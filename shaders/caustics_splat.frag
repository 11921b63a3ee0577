#version 460
#extension GL_GOOGLE_include_directive : require
#include "caustics.glsl"

layout(location = 0) in vec2 p;          /* position on the surface */
layout(location = 1) flat in float flux; /* flat, because slivers would extrapolate it */
layout(location = 0) out float raw;      /* blended by addition */

/* Light is inversely proportional to the width of its beam: it is the area of a texel on the
 * surface over its own area, which is constant over the flat triangle and independent of its
 * orientation. */
void main()
{
    vec2 x = dFdx(p);
    vec2 y = dFdy(p);
    vec2 texel = map_texel_size();
    float ratio = abs(x.x * y.y - x.y * y.x) / (texel.x * texel.y);
    raw = flux * min(ratio, CAUSTICS_MOST);
}
