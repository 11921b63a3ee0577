/* paint_instances.vert: triangles from a vertex buffer, each instance moved by its own element of
 * another. */
#version 460

layout(location = 0) in vec2 position;
layout(location = 3) in vec2 move;

void main()
{
    gl_Position = vec4(position + move, 0, 1);
}
