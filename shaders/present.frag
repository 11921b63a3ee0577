#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/srgb.glsl"
#include "present.h"

layout(set = 0, binding = PRESENT_PICTURE) uniform sampler2D picture;

layout(push_constant, scalar) uniform Push
{
    present_push push;
};

layout(location = 0) out vec4 shown;

void main()
{
    vec3 c = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
    uint column = uint(gl_FragCoord.x);
    c = PRESENT_IS_BRIGHT(column, push.line) ? vec3(1.0) : c;
    c = PRESENT_IS_DARK(column, push.line) ? vec3(0.0) : c;
    shown = vec4(push.encodes != 0 ? srgb_decode(c) : c, 1.0);
}
