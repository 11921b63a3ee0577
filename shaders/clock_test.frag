#version 460
#extension GL_GOOGLE_include_directive : require
#include "clock_test.h"
#include "lib/busy.glsl"

layout(push_constant, scalar) uniform Push
{
    clock_test_push push;
};

layout(location = 0) out vec4 color;

void main()
{
    color = vec4(busy(fract(gl_FragCoord.x * 0.37 + gl_FragCoord.y * 0.11) + 0.01, push.rounds));
}
