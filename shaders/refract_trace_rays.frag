#version 460
#extension GL_GOOGLE_include_directive : require
#ifdef TRACE_QUERY
#extension GL_EXT_ray_query : require
#endif
#define TRACE_RAYS
#include "refract_trace.glsl"
