#version 460
#extension GL_GOOGLE_include_directive : require
/* Without clipping cracks may reach beyond the fitted planes. */
#define CRACKS_CLIP frame.clip_from_world
#include "cracks_vert.glsl"
