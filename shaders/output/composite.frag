/* composite.frag: composites air, bubbles, cracks and highlights over the ice. */
#version 460
#include "lib/specialization_constants.glsl"
#include "output/composite.h"

layout(set = 0, binding = COMPOSITE_HIGHLIGHT) uniform sampler2D highlights;
layout(set = 0, binding = COMPOSITE_AIR) uniform sampler2D air;
layout(set = 0, binding = COMPOSITE_BUBBLES) uniform sampler2D bubbles;
layout(set = 0, binding = COMPOSITE_CRACKS) uniform sampler2D cracks;

layout(location = 0) flat in vec3 light; /* in-scattered light of the air */

layout(location = 0) out vec4 color; /* premultiplied alpha */

void blend_over(vec4 upper)
{
    color = upper + (1.0 - upper.a) * color;
}

vec4 layer_texel(sampler2D layer)
{
    if ((constant_composite & COMPOSITE_IS_LOW_RES) != 0u)
        return textureLod(layer, gl_FragCoord.xy / vec2(textureSize(highlights, 0)), 0.0);
    return texelFetch(layer, ivec2(gl_FragCoord.xy), 0);
}

void main()
{
    float highlight = texelFetch(highlights, ivec2(gl_FragCoord.xy), 0).r;
    if (highlight < 0.0)
        discard;
    color = vec4(0.0);
    if ((constant_composite & COMPOSITE_HAS_AIR) != 0u)
        color = vec4(light, 1.0) * layer_texel(air).r;
    if ((constant_composite & COMPOSITE_HAS_BUBBLES) != 0u)
        blend_over(layer_texel(bubbles));
    if ((constant_composite & COMPOSITE_HAS_CRACKS) != 0u)
        blend_over(layer_texel(cracks));
    if ((constant_composite & COMPOSITE_HAS_HIGHLIGHT) != 0u)
        color.rgb += highlight; /* added, does not change the coverage */
}
