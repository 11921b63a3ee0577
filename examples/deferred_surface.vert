/* deferred_surface.vert: generates a box of 36 vertices without a vertex buffer. */
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(location = 0) out vec3 position;
layout(location = 1) out vec4 color;

layout(push_constant, scalar) uniform Push
{
    mat4 clip_from_world;
    vec3 center;
    float size;
    vec4 color;
}

push;

void main()
{
    int face = gl_VertexIndex / 6;
    vec2 corner = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1),
                         vec2(1, 1))[gl_VertexIndex % 6];
    vec3 at = vec3(corner, face % 2 == 0 ? 1.0 : -1.0);
    at = face < 2 ? at : face < 4 ? at.zxy : at.yzx;
    position = push.center + push.size * at;
    color = push.color;
    gl_Position = push.clip_from_world * vec4(position, 1.0);
}
