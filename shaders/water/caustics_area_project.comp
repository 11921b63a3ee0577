/* caustics_area_project.comp: compute shader that traces sunlight from the surface grid to the
 * floor. */
#version 460
#include "water/caustics.glsl"

layout(local_size_x = CAUSTICS_GROUP_2D, local_size_y = CAUSTICS_GROUP_2D) in;
layout(set = 0, binding = CAUSTICS_LANDING, rgba32f) uniform writeonly image2D landing;

void main()
{
    ivec2 corner = ivec2(gl_GlobalInvocationID.xy);
    if (max(corner.x, corner.y) > CAUSTICS_GRID)
        return;
    vec2 p = (vec2(corner) / float(CAUSTICS_GRID) - 0.5) * push.pool.size;
    imageStore(landing, corner, vec4(land(p, pool_sun_dir()), 0.0));
}
