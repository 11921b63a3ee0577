/* timestamp_check.frag: fragment shader of a test load for src/lab/profile/timestamp_check.c. */
#version 460
#include "lib/gpu_busy_loop.glsl"
#include "output/timestamp_check.h"

layout(push_constant, scalar) uniform Push
{
    timestamp_check_push push;
};

layout(location = 0) out vec4 color;

void main()
{
    color = vec4(busy(fract(gl_FragCoord.x * 0.37 + gl_FragCoord.y * 0.11) + 0.01, push.rounds));
}
