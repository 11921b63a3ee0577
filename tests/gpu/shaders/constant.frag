/* constant.frag: a colour that specialization constants may change. */
#version 460

layout(constant_id = 3) const float red = 0.25;
layout(constant_id = 7) const uint green = 5u;

layout(location = 0) out vec4 color;

void main()
{
    color = vec4(red, green, 0.0, 1.0);
}
