#version 460
#extension GL_GOOGLE_include_directive : require

layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 back; /* outward unit normal, world; w: 1 */

void main()
{
    back = vec4(normalize(normal), 1.0);
}
