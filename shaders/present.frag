#version 460
#extension GL_GOOGLE_include_directive : require
#include "present.h"

layout(set = 0, binding = PRESENT_PICTURE) uniform sampler2D picture;

layout(push_constant, scalar) uniform Push
{
    present_push push;
};

layout(location = 0) out vec4 shown;

/* IEC 61966-2-1, decoded */
vec3 linear(vec3 c)
{
    vec3 low = c / 12.92;
    vec3 high = pow((c + 0.055) / 1.055, vec3(2.4));
    return mix(high, low, lessThanEqual(c, vec3(0.04045)));
}

void main()
{
    vec3 c = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
    uint column = uint(gl_FragCoord.x);
    c = PRESENT_IS_BRIGHT(column, push.line) ? vec3(1.0) : c;
    c = PRESENT_IS_DARK(column, push.line) ? vec3(0.0) : c;
    shown = vec4(push.encodes != 0 ? linear(c) : c, 1.0);
}
