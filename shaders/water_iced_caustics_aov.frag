#version 460
#extension GL_GOOGLE_include_directive : require
#define WATER_WITH_ICE
#include "water_aov.glsl"
