#version 460
#extension GL_GOOGLE_include_directive : require
#define WATER_WITH_CAUSTICS
#include "water.glsl"

layout(location = 0) out float out_caustics;

void main()
{
    out_caustics = water_look().caustics;
}
