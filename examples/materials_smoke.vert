/* materials_smoke.vert: rectangles that face the camera, six vertices each, along a line. */
#version 460

layout(location = 0) out vec2 uv;

layout(push_constant) uniform Push
{
    mat4 clip_from_world;
}

push;

void main()
{
    float i = float(gl_VertexIndex / 6);
    vec2 corner = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1),
                         vec2(1, 1))[gl_VertexIndex % 6];
    vec3 center = vec3(0.2 * i - 4.0, 0.25 + 0.1 * sin(2.0 * i), -0.1 + 0.3 * cos(3.0 * i));
    uv = corner;
    gl_Position = push.clip_from_world * vec4(center, 1.0);
    gl_Position.xy += vec2(1.2, 1.6) * 0.5 * corner;
}
