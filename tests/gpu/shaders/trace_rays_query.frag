/* trace_rays_query.frag: what rays meet by ray queries. */
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#define TRACE_QUERY
#include "tests/gpu/shaders/trace_rays.glsl"
