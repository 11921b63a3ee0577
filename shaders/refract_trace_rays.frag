#version 460
#extension GL_GOOGLE_include_directive : require
#define TRACE_RAYS
#include "refract_trace.glsl"
