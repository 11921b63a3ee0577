#version 460
#extension GL_GOOGLE_include_directive : require
#define REFRACT_BUMP
#include "refract_paper.glsl"

#include "refract_color.glsl"
