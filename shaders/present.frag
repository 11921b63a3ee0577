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

/* Filtered only where its size is another one; its texels' edges are clamped by the sampler. */
vec3 fetch(uvec2 at, uvec2 size)
{
    if (size == uvec2(push.texel_columns, push.texel_rows))
        return texelFetch(picture, ivec2(at), 0).rgb;
    vec2 part = (vec2(at) + 0.5) / vec2(size);
    vec2 texels = vec2(push.texel_columns, push.texel_rows);
    vec2 inside = clamp(part * texels, vec2(0.5), texels - 0.5);
    return textureLod(picture, inside / vec2(textureSize(picture, 0)), 0.0).rgb;
}

void main()
{
    /* left of and above the picture it wraps to more than any size */
    uvec2 at = uvec2(gl_FragCoord.xy) - uvec2(push.x, push.y);
    uvec2 size = uvec2(push.width, push.height);
    uvec3 surround = uvec3(push.surround >> 16, push.surround >> 8, push.surround) & 255u;
    vec3 c = vec3(surround) / 255.0;
    if (all(lessThan(at, size))) {
        c = fetch(at, size);
        c = PRESENT_IS_BRIGHT(at.x, push.line) ? vec3(1.0) : c;
        c = PRESENT_IS_DARK(at.x, push.line) ? vec3(0.0) : c;
    }
    shown = vec4(push.encodes != 0 ? srgb_decode(c) : c, 1.0);
}
