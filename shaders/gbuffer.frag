#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/globals.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 out_normal;
layout(location = 1) out vec4 out_position; /* w: distance along the view's axis */

void main()
{
    out_normal = vec4(normalize(normal), 0.0);
    out_position = vec4(position, dot(position - frame.eye, frame.forward));
}
