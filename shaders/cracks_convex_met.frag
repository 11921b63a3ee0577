#version 460
#extension GL_GOOGLE_include_directive : require
#define CRACKS_BEFORE_BACK
#include "cracks_convex.glsl"

#include "cracks_met.glsl"
