/* random.vert: one triangle that covers everything. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/random.h"

layout(push_constant, scalar) uniform Push
{
    random_push push;
};

void main()
{
    const vec2 corners[] = { vec2(-1), vec2(-1, 3), vec2(3, -1) };
    gl_Position = vec4(corners[gl_VertexIndex], push.depth, 1);
}
