#version 460
#extension GL_GOOGLE_include_directive : require
#define REFRACT_PER_VERTEX
#include "refract_vert.glsl"
