/* trace_rays.frag: what rays meet by a tree. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/trace_rays.glsl"
