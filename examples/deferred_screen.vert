/* deferred_screen.vert: full-screen triangle. */
#version 460

layout(location = 0) out vec2 uv;

void main()
{
    uv = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0;
    gl_Position = vec4(2.0 * uv - 1.0, 0.0, 1.0);
}
