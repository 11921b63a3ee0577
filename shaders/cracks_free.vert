#version 460
#extension GL_GOOGLE_include_directive : require
/* Unclipped cracks may extend beyond the near and far planes fitted to the ice. */
#define CRACKS_CLIP frame.clip_from_world
#include "cracks_vert.glsl"
