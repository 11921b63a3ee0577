#version 460
#extension GL_GOOGLE_include_directive : require
#define BACKGROUND_EXTRA
#define BACKGROUND_MIRROR
#include "background_materials.glsl"
