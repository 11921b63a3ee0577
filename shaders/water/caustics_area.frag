/* caustics_area.frag: fragment shader of pool caustics: light of a projected grid triangle. */
#version 460
#include "water/caustics.glsl"

layout(location = 0) in vec2 p;          /* position on the water surface */
layout(location = 1) flat in float flux; /* flat: slivers would extrapolate it */
layout(location = 0) out float raw;      /* accumulated by additive blending */

/* Computes the light of a projected grid triangle. The light is the flux times a ratio: a texel's
 * area on the surface to its area on the floor. The ratio is constant over a flat triangle. */
void main()
{
    vec2 x = dFdx(p);
    vec2 y = dFdy(p);
    vec2 texel = map_texel_size();
    float ratio = abs(x.x * y.y - x.y * y.x) / (texel.x * texel.y);
    raw = flux * min(ratio, CAUSTICS_TRIANGLE_MAX);
}
