#version 460
#extension GL_GOOGLE_include_directive : require
#define WATER_WITH_CAUSTICS
#include "water_ice_color.glsl"
