#version 460
#extension GL_GOOGLE_include_directive : require
#include "background.h"
#include "lib/ice_shine.glsl"

layout(push_constant, scalar) uniform Push
{
    background_push push;
};

layout(location = 0) in vec3 eye_to_point;
layout(location = 1) in vec3 normal;
layout(location = 0) out float seen;

void main()
{
    ice_shine shine = ice_shine_at(push.eye + eye_to_point, normalize(normal));
    seen = shine.own * shine.open + shine.through.g;
}
