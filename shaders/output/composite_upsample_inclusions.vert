/* composite_upsample_inclusions.vert: vertex shader of upsampling: full-screen triangle with its
 * uv. */
#version 460

layout(location = 0) out vec2 uv;

void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 2.0 : 0.0, gl_VertexIndex == 2 ? 2.0 : 0.0);
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
    uv = corner;
}
