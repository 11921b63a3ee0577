#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pose.glsl"

layout(location = MESH_POSITION) in vec3 position;

void main()
{
    gl_Position = frame.fitted_clip_from_world * vec4(pose_object(position), 1.0);
}
