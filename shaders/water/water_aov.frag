/* water_aov.frag: main() of the AOV layer `caustics`: sunlight on the ground below the water. */
#version 460
#extension GL_GOOGLE_include_directive : require
#define WATER_WITH_CAUSTICS
#include "water/water_surface.glsl"

layout(location = 0) out float out_caustics;

void main()
{
    out_caustics = water_shade().caustics;
}
