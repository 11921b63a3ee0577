#version 460
#extension GL_GOOGLE_include_directive : require
#include "cracks_convex.glsl"

#include "cracks_color.glsl"
