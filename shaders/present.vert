#version 460
#extension GL_GOOGLE_include_directive : require
#include "present.h"

layout(push_constant, scalar) uniform Push
{
    present_push push;
};

/* A triangle that covers the window from its edge `left` on. */
void main()
{
    float x = gl_VertexIndex == 1 ? push.left + 4.0 : push.left;
    gl_Position = vec4(x, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
