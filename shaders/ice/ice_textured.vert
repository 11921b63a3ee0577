/* ice_textured.vert: vertex shader of the G-buffer passes of textured ice. */
#version 460
#include "ice/ice_textured.h"
#include "lib/object_pose.glsl"
#include "lib/optics.glsl"
#include "lib/primary_ray.glsl"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;
layout(location = MESH_COLOR) in vec3 color;
layout(location = MESH_UV) in vec2 uv;

layout(location = ICE_MATERIAL_EYE_TO_POINT) out vec3 out_eye_to_point;
layout(location = ICE_MATERIAL_NORMAL) out vec3 out_normal;
layout(location = ICE_MATERIAL_FRESNEL) out float out_fresnel;
layout(location = ICE_MATERIAL_COLOR) out vec3 out_color;
layout(location = ICE_MATERIAL_UV) out vec2 out_uv;

void main()
{
    /* `precise` makes all passes compute exactly equal depths for a face */
    precise vec3 point = pose_object(position);
    precise vec4 clip = frame.clip_from_world * vec4(point, 1.0);
    gl_Position = clip;
    out_eye_to_point = point - frame.eye;
    out_normal = pose_object_normal(normal);
    out_fresnel = optics_fresnel_paper(primary_ray_dir(out_eye_to_point), out_normal);
    out_color = color;
    out_uv = uv;
}
