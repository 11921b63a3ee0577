#version 460
#extension GL_GOOGLE_include_directive : require
#include "refract_paper.glsl"

#include "refract_color.glsl"
