/* deferred_down.frag: downsamples to the next mip level with a 4-tap filter. */
#version 460

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 smaller;
layout(binding = 0) uniform sampler2D larger;

void main()
{
    vec2 texel = 1.0 / vec2(textureSize(larger, 0));
    smaller =
        0.25 *
        (texture(larger, uv + texel * vec2(-1, -1)) + texture(larger, uv + texel * vec2(1, -1)) +
         texture(larger, uv + texel * vec2(-1, 1)) + texture(larger, uv + texel * vec2(1, 1)));
}
