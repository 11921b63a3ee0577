/* gbuffer.vert: vertex shader of the G-buffer of the visible surface: normal and position. */
#version 460
#include "lib/object_pose.glsl"
#include "output/gbuffer.h"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;
layout(location = MESH_UV) in vec2 uv;
layout(location = MESH_MATERIAL) in uint material;

layout(push_constant, scalar) uniform Push
{
    gbuffer_push push;
};

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_uv;
layout(location = 3) flat out uint out_material; /* 0 for no alpha cut-out */

void main()
{
    bool object = push.object != 0u;
    out_position = object ? pose_object(position) : pose_surroundings(position, material);
    out_normal = object ? pose_object_normal(normal) : pose_surroundings_normal(normal, material);
    out_uv = uv;
    out_material = object ? 0u : material;
    gl_Position = frame.clip_from_world * vec4(out_position, 1.0);
}
