#version 460
#extension GL_GOOGLE_include_directive : require
#include "background_vertices_vert.glsl"
