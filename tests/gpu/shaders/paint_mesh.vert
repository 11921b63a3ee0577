/* paint_mesh.vert: triangles from a vertex buffer, in clip space. */
#version 460

layout(location = 2) in vec2 position;

void main()
{
    gl_Position = vec4(position, 0, 1);
}
