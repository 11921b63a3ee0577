/* gbuffer.vert: vertex shader of the G-buffer: normal, position and object of the visible surface.
 */
#version 460
#include "lib/object_pose.glsl"
#include "output/gbuffer.h"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;
layout(location = MESH_UV) in vec2 uv;
layout(location = MESH_MATERIAL) in uint material;

layout(set = 0, binding = GBUFFER_STARTS) uniform sampler2D starts;

layout(push_constant, scalar) uniform Push
{
    gbuffer_push push;
};

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_uv;
layout(location = 3) flat out uint out_material; /* 0 for no alpha cut-out */
layout(location = 4) flat out float out_number;

/* Returns the vertex's object number by binary search, like model_surroundings_find_object(). */
uint find_number()
{
    uint low = 0u, high = push.count;
    while (low < high) {
        uint mid = (low + high) / 2u;
        ivec2 texel = ivec2(mid % GBUFFER_STARTS_WIDTH, mid / GBUFFER_STARTS_WIDTH);
        if (packUnorm4x8(texelFetch(starts, texel, 0)) <= uint(gl_VertexIndex))
            low = mid + 1u;
        else
            high = mid;
    }
    return push.id + low;
}

void main()
{
    bool object = push.object != 0u;
    out_position = object ? pose_object(position) : pose_surroundings(position, material);
    out_normal = object ? pose_object_normal(normal) : pose_surroundings_normal(normal, material);
    out_uv = uv;
    out_material = object ? 0u : material;
    out_number = float(find_number());
    gl_Position = frame.clip_from_world * vec4(out_position, 1.0);
}
