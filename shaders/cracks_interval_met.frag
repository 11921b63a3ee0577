#version 460
#extension GL_GOOGLE_include_directive : require
#include "cracks_interval.glsl"

#include "cracks_met.glsl"
