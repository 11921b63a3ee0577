/* triangle.vert: the half of a rectangle at its first corner; of six vertices three are nothing. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/paint.h"

layout(push_constant, scalar) uniform Push
{
    paint_push push;
};

void main()
{
    const vec2 corners[] = { vec2(0), vec2(0, 1), vec2(1, 0), vec2(0), vec2(0), vec2(0) };
    gl_Position = vec4(mix(push.from, push.to, corners[gl_VertexIndex]), push.depth, 1);
}
