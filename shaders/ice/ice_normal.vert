/* ice_normal.vert: vertex shader of ice normals. ICE_WIDE widens the view beyond the image. */
#version 460
#include "lib/object_pose.glsl"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;

layout(location = 0) out vec3 out_normal;

void main()
{
    gl_Position = frame.clip_from_world * vec4(pose_object(position), 1.0);
#ifdef ICE_WIDE
    gl_Position.xy *= frame.wide_scale;
#endif
    out_normal = pose_object_normal(normal);
}
