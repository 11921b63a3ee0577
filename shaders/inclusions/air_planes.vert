/* air_planes.vert: vertex shader of the textured planes that show milky air in the ice. */
#version 460
#include "inclusions/air_planes.h"
#include "lib/object_pose.glsl"

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;
layout(location = MESH_UV) in vec2 uv;
layout(location = MESH_MATERIAL) in uint material;

layout(location = 0) out vec3 out_uv; /* z: layer of the texture array */
layout(location = 1) out vec3 out_eye_to_point;
layout(location = 2) out vec3 out_normal;

void main()
{
    vec3 point = pose_object(position);
    gl_Position = frame.fitted_clip_from_world * vec4(point, 1.0);
    out_eye_to_point = point - frame.eye;
    out_normal = pose_object_normal(normal);
    out_uv = vec3(uv, float((material & MESH_TEXTURE_MASK) - 1u));
}
