#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/srgb.glsl"
#include "present.h"

layout(constant_id = PRESENT_ENCODES) const uint encodes = 0u;

layout(set = 0, binding = PRESENT_PICTURE) uniform sampler2D picture;

layout(push_constant, scalar) uniform Push
{
    present_push push;
};

layout(location = 0) out vec4 shown;

vec3 fetch(uvec2 at)
{
#ifdef PRESENT_SCALED
    return textureLod(picture, (vec2(at) + 0.5) * push.part, 0.0).rgb;
#else
    return texelFetch(picture, ivec2(at), 0).rgb;
#endif
}

void main()
{
    uvec2 at = uvec2(gl_FragCoord.xy) - uvec2(push.x, push.y);
    vec3 c = fetch(at);
#ifdef PRESENT_SCALED
    uvec3 around = uvec3(push.surround >> 16, push.surround >> 8, push.surround) & 255u;
    c = any(greaterThanEqual(at, uvec2(push.width, push.height))) ? vec3(around) / 255.0 : c;
#endif
    c = PRESENT_IS_BRIGHT(at.x, push.line) ? vec3(1.0) : c;
    c = PRESENT_IS_DARK(at.x, push.line) ? vec3(0.0) : c;
    shown = vec4(encodes != 0 ? srgb_decode(c) : c, 1.0);
}
