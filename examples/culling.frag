/* culling.frag: a face of a cube, in one colour. */
#version 460

layout(location = 0) flat in vec3 color;
layout(location = 0) out vec4 shown;

void main()
{
    shown = vec4(color, 1.0);
}
