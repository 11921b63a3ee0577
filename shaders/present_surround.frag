#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/srgb.glsl"
#include "present.h"

layout(constant_id = PRESENT_ENCODES) const uint encodes = 0u;

layout(push_constant, scalar) uniform Push
{
    present_push push;
};

layout(location = 0) out vec4 shown;

void main()
{
    uvec3 surround = uvec3(push.surround >> 16, push.surround >> 8, push.surround) & 255u;
    vec3 c = vec3(surround) / 255.0;
    shown = vec4(encodes != 0 ? srgb_decode(c) : c, 1.0);
}
