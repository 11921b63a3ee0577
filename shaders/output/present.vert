/* present.vert: vertex shader that shows the image in the window: full-screen triangle with uv. */
#version 460
#include "output/present.h"

layout(push_constant, scalar) uniform Push
{
    present_push push;
};

layout(location = 0) out vec2 uv;

void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    uv = corner * push.uv_from_clip + push.uv_of_center;
    gl_Position = vec4(corner, 0.0, 1.0);
}
