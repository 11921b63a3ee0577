#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice_front.glsl"
