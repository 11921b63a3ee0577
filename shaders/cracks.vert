#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pose.glsl"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;

layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;

void main()
{
    gl_Position = frame.fitted_clip_from_world * vec4(pose_object(position), 1.0);
    out_position = position;
    out_normal = normal;
}
