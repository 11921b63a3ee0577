#version 460
#extension GL_GOOGLE_include_directive : require
#define REFRACT_BOUNCE
#define REFRACT_SEEN
#define REFRACT_SEEN_IO in
#include "refract.glsl"
#include "refract_march.glsl"
