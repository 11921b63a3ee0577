/* random.frag: all targets from all inputs. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/random.glsl"

#ifdef SUMS
layout(location = 0) out float color;
#else
layout(location = 0) out uvec4 colors[TARGETS];
#endif

void main()
{
    uint sum = inputs(uvec3(gl_FragCoord.xy, 0));
#ifdef SUMS
    color = float(random_small(sum));
#else
    for (int i = 0; i < TARGETS; i++)
        colors[i] = channels(sum, i);
#endif
}
