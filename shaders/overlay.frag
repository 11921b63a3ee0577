#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/srgb.glsl"
#include "overlay.h"

layout(set = 0, binding = OVERLAY_FONT) uniform sampler2D font;

layout(push_constant, scalar) uniform Push
{
    overlay_push push;
};

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;

layout(location = 0) out vec4 premultiplied;

void main()
{
    float alpha = color.a * texture(font, uv).r;
    vec3 c = push.encodes != 0 ? srgb_decode(color.rgb) : color.rgb;
    premultiplied = vec4(c * alpha, alpha);
}
