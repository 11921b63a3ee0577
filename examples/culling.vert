/* culling.vert: the cubes of a list, 36 vertices each. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "culling.glsl"

layout(location = 0) flat out vec3 color;

layout(binding = 1) readonly buffer Visible
{
    uint visible[];
};

layout(push_constant) uniform Push
{
    mat4 clip_from_world;
}

push;

void main()
{
    int face = gl_VertexIndex / 6;
    vec2 corner = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1),
                         vec2(1, 1))[gl_VertexIndex % 6];
    vec3 at = vec3(corner, face % 2 == 0 ? 1.0 : -1.0);
    at = face < 2 ? at : face < 4 ? at.zxy : at.yzx;
    vec3 center = cube_center(visible[gl_InstanceIndex]);
    color = (0.5 + center / 16.0) * (face < 2 ? 0.8 : face < 4 ? 1.0 : 0.6);
    gl_Position = push.clip_from_world * vec4(center + cube_size * at, 1.0);
}
