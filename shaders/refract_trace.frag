#version 460
#extension GL_GOOGLE_include_directive : require
#ifdef TRACE_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "refract_trace.glsl"
