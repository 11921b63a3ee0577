#version 460
#extension GL_GOOGLE_include_directive : require
#define BACKGROUND_MIRROR
#define BACKGROUND_SHINE
#include "background_materials.glsl"
