/* surroundings.vert: vertex shader of surroundings; SURROUNDINGS_EXTRA adds struct mesh_extra. */
#version 460
#include "lib/object_pose.glsl"
#include "surroundings/surroundings.h"
#ifdef SURROUNDINGS_EXTRA
#include "lib/vertex_tangent_uv1.glsl"
#endif

layout(push_constant, scalar) uniform Push
{
    surroundings_push push;
};

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;
layout(location = MESH_COLOR) in vec3 color;
layout(location = MESH_UV) in vec2 uv;
layout(location = MESH_MATERIAL) in uint material;

layout(location = 0) out vec3 out_eye_to_point;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec3 out_color;
layout(location = 3) out vec2 out_uv;
layout(location = 4) flat out uint out_material;
#ifdef SURROUNDINGS_EXTRA
layout(location = 5) out vec2 out_other_uv;
layout(location = 6) out vec4 out_tangent;
#endif

void main()
{
    /* `precise`, because the AOV passes test for equal depth */
    precise vec3 point = pose_surroundings(position, material);
    precise vec4 clip = push.clip_from_world * vec4(point, 1.0);
    gl_Position = clip;
    out_eye_to_point = point - push.eye;
    out_normal = pose_surroundings_normal(normal, material);
    out_color = color;
    out_uv = uv;
    out_material = material;
#ifdef SURROUNDINGS_EXTRA
    out_tangent = vertex_extra_texel(0);
    out_other_uv = vertex_extra_texel(1).xy;
#endif
}
