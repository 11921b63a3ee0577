/* deferred_surface.frag: writes the G-buffer that deferred_light.frag reads. */
#version 460

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 color_out;
layout(location = 1) out vec4 normal_out;
layout(location = 2) out vec4 position_out;

void main()
{
    vec3 normal = normalize(cross(dFdy(position), dFdx(position)));
    color_out = color;
    normal_out = vec4(normal, 1.0);
    position_out = vec4(position, 1.0);
}
