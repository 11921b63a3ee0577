#version 460
#extension GL_GOOGLE_include_directive : require
#define REFRACT_BOUNCE
#define REFRACT_EXITS
#define REFRACT_NEAREST
#define REFRACT_SEEN
#include "refract.glsl"
