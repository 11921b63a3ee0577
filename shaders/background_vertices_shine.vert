#version 460
#extension GL_GOOGLE_include_directive : require
#define BACKGROUND_SHINE
#include "background_vertices_vert.glsl"
