/* clear.frag: fragment shader that writes zero to a colour target. */
#version 460

layout(location = 0) out vec4 color;

void main()
{
    color = vec4(0.0);
}
