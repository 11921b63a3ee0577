/* ssr_downsample.frag: fragment shader that downsamples a mip level by 2 x 2 texels. */
#version 460
#include "surroundings/ssr.h"

layout(set = 0, binding = SSR_COLOR) uniform sampler2D larger;

layout(location = 0) out vec4 color;

void main()
{
    vec2 size = max(vec2(textureSize(larger, 0)) * 0.5, vec2(1.0));
    color = textureLod(larger, gl_FragCoord.xy / size, 0.0);
}
