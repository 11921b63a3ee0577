/* present.frag: fragment shader that shows the image in the window; PRESENT_SCALED scales it. */
#version 460
#include "lib/srgb.glsl"
#include "output/present.h"

layout(constant_id = PRESENT_ENCODES) const uint encodes = 0u;

layout(set = 0, binding = PRESENT_IMAGE) uniform sampler2D image;

layout(push_constant, scalar) uniform Push
{
    present_push push;
};

layout(location = 0) in vec2 uv;

layout(location = 0) out vec4 shown;

void main()
{
#ifdef PRESENT_SCALED
    vec3 c = texture(image, uv).rgb;
#else
    vec3 c = texelFetch(image, ivec2(gl_FragCoord.xy) - ivec2(push.x, push.y), 0).rgb;
#endif
    shown = vec4(encodes != 0 ? srgb_decode(c) : c, 1.0);
}
