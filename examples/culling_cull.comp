/* culling_cull.comp: appends the cubes whose bounding sphere touches the frustum to a list. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "culling.glsl"

layout(local_size_x = 64) in;

layout(binding = 0) buffer Draw
{
    uint vertex_count, instance_count, first_vertex, first_instance;
}

draw;

layout(binding = 1) writeonly buffer Visible
{
    uint visible[];
};

layout(push_constant) uniform Push
{
    mat4 clip_from_world;
}

push;

void main()
{
    mat4 rows = transpose(push.clip_from_world);
    vec4 center = vec4(cube_center(gl_GlobalInvocationID.x), 1.0);
    vec4 planes[] = { rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                      rows[3] - rows[1], rows[2],           rows[3] - rows[2] };
    bool is_visible = true;
    for (int i = 0; i < 6; i++)
        is_visible =
            is_visible && dot(planes[i], center) > -1.733 * cube_size * length(planes[i].xyz);
    if (is_visible)
        visible[atomicAdd(draw.instance_count, 1u)] = gl_GlobalInvocationID.x;
}
