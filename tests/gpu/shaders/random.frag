/* random.frag: all targets from all inputs. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/random.glsl"

layout(location = 0) out uvec4 colors[TARGETS];

void main()
{
    uint sum = inputs(uvec3(gl_FragCoord.xy, 0));
    for (int i = 0; i < TARGETS; i++)
        colors[i] = channels(sum, i);
}
