/* trace_rays.glsl: main() of shaders that tell what rays meet, by trace_bvh.glsl. */
#include "shaders/lib/specialization_constants.glsl"
#include "shaders/trace/trace_bvh.glsl"
#include "tests/gpu/shaders/trace_rays.h"

layout(set = 0, binding = TRACE_RAYS_BINDING) uniform samplerBuffer rays;
layout(location = 0) out vec4 found; /* t, u, v, triangle */

void main()
{
    int at = int(gl_FragCoord.y) * TRACE_RAYS_SIDE + int(gl_FragCoord.x);
    vec4 from = texelFetch(rays, TRACE_RAYS_TEXELS * at);
    vec4 to = texelFetch(rays, TRACE_RAYS_TEXELS * at + 1);
    trace_start start = trace_start(from.xyz, to.xyz, to.w, 1e30, -1, false, ~0u);
    trace_hit hit = trace_hit(1e30, 0.0, 0.0, -1, 0);
    trace_hit_in_world(start, BVH_OBJECTS, hit);
    found = vec4(hit.t, hit.u, hit.v, float(hit.triangle));
}
