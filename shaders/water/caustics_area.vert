/* caustics_area.vert: vertex shader of pool caustics: surface grid projected to the floor. */
#version 460
#include "lib/grid_strip.glsl"
#include "water/caustics.glsl"

layout(set = 0, binding = CAUSTICS_LANDING) uniform sampler2D landing;

layout(location = 0) out vec2 out_p; /* position on the water surface */
layout(location = 1) flat out float out_flux;

void main()
{
    ivec2 corner = ivec2(grid_strip_corner(uint(gl_VertexIndex), CAUSTICS_GRID));
    vec4 landed = texelFetch(landing, corner, 0);
    vec4 region = map_region();
    gl_Position = vec4(2.0 * (landed.xy - region.xy) / region.zw - 1.0, 0.5, 1.0);
    out_p = (vec2(corner) / float(CAUSTICS_GRID) - 0.5) * push.pool.size;
    out_flux = landed.z;
}
