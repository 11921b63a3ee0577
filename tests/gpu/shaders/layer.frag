/* layer.frag: the number from layer.vert. */
#version 460

layout(location = 0) in float number;
layout(location = 0) out vec4 color;

void main()
{
    color = vec4(number, 0, 0, 1);
}
