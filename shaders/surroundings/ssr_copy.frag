/* ssr_copy.frag: fragment shader that copies the objects' colour and depth before surroundings are
 * drawn over them, for screen-space reflections. */
#version 460
#include "surroundings/ssr.h"

layout(set = 0, binding = SSR_COLOR) uniform sampler2D image;
layout(set = 0, binding = SSR_DEPTH) uniform sampler2D depths;

layout(location = 0) out vec4 objects; /* premultiplied alpha */
layout(location = 1) out float front;

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 color = min(texelFetch(image, at, 0).rgb, vec3(SSR_RADIANCE_MAX));
    front = texelFetch(depths, at, 0).r;
    objects = front > 0.0 ? vec4(color, 1.0) : vec4(0.0); /* else undefined */
}
