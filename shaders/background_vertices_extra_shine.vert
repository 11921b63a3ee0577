#version 460
#extension GL_GOOGLE_include_directive : require
#define BACKGROUND_SHINE
#define BACKGROUND_EXTRA
#include "background_vertices_vert.glsl"
