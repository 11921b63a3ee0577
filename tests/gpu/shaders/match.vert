/* match.vert: a vertex attribute and push constants, for rows that may differ from it. */
#version 460

layout(location = 0) in vec3 position;
layout(location = 0) out vec2 uv;

layout(push_constant) uniform Push
{
    vec2 offset;
    float scale;
}

push;

void main()
{
    uv = position.xy;
    gl_Position = vec4(position * push.scale + vec3(push.offset, 0.0), 1.0);
}
