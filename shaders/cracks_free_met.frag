#version 460
#extension GL_GOOGLE_include_directive : require
#include "cracks_free.glsl"

#include "cracks_met.glsl"
