/* particles.frag: a soft round spot, blended additively. */
#version 460

layout(location = 0) in vec2 corner;
layout(location = 1) in vec3 color;
layout(location = 0) out vec4 added;

void main()
{
    added = vec4(0.3 * color * max(0.0, 1.0 - dot(corner, corner)), 1.0);
}
