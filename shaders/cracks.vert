#version 460
#extension GL_GOOGLE_include_directive : require
#define CRACKS_CLIP frame.fitted_clip_from_world
#include "cracks_vert.glsl"
