#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/optics.glsl"
#include "lib/pose.glsl"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;

layout(location = 0) out vec3 out_eye_to_point;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out float out_fresnel;

void main()
{
    /* two passes must agree: the layers are tested against the depth that the picture wrote */
    precise vec3 point = pose_object(position);
    precise vec4 clip = frame.clip_from_world * vec4(point, 1.0);
    gl_Position = clip;
    out_eye_to_point = point - frame.eye;
    out_normal = pose_object_normal(normal);
    out_fresnel = optics_fresnel_paper(normalize(out_eye_to_point), out_normal);
}
