#version 460
#extension GL_GOOGLE_include_directive : require
#include "water_ice_color.glsl"
