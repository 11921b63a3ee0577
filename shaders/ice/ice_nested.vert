/* ice_nested.vert: vertex shader of nested objects. ICE_WIDE widens the view beyond the image. */
#version 460
#include "lib/object_pose.glsl"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;

layout(location = 0) out vec3 out_normal;

void main()
{
    /* `precise`, because depths of inner nesting levels are compared with those of outer ones */
    precise vec3 point = pose_object(position);
    precise vec4 clip = frame.clip_from_world * vec4(point, 1.0);
    gl_Position = clip;
#ifdef ICE_WIDE
    gl_Position.xy *= frame.wide_scale;
#endif
    out_normal = pose_object_normal(normal);
}
