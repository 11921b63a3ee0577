#version 460
#extension GL_GOOGLE_include_directive : require
#include "caustics.glsl"

layout(location = 0) in vec2 p;          /* on the surface */
layout(location = 1) flat in float flux; /* slivers would extrapolate it */
layout(location = 0) out float raw;      /* adds */

/* Light is dimmed as its beam widens: the area that a texel has on the surface over its own. The
 * triangle is flat, so that this holds for all of it; turned over it is as bright. */
void main()
{
    vec2 x = dFdx(p);
    vec2 y = dFdy(p);
    vec2 texel = map_texel_size();
    float ratio = abs(x.x * y.y - x.y * y.x) / (texel.x * texel.y);
    raw = flux * min(ratio, CAUSTICS_MOST);
}
