/* ui_overlay.frag: fragment shader of the user interface drawn over the image. */
#version 460
#include "lib/srgb.glsl"
#include "output/present.h"
#include "output/ui_overlay.h"

layout(set = 0, binding = OVERLAY_FONT) uniform sampler2D font;

layout(constant_id = PRESENT_ENCODES) const uint encodes = 0u;

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;

layout(location = 0) out vec4 premultiplied;

void main()
{
    vec4 texel = texture(font, uv) * color;
    vec3 c = encodes != 0 ? srgb_decode(texel.rgb) : texel.rgb;
    premultiplied = vec4(c * texel.a, texel.a);
}
