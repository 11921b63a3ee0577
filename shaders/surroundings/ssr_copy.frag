#version 460
#extension GL_GOOGLE_include_directive : require
#include "surroundings/ssr.h"

layout(set = 0, binding = SSR_COLOR) uniform sampler2D image;
layout(set = 0, binding = SSR_DEPTH) uniform sampler2D depths;

layout(location = 0) out vec4 objects; /* premultiplied alpha */
layout(location = 1) out float front;

/* Copies the objects' colour and depth before the surroundings are drawn over them. */
void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 color = min(texelFetch(image, at, 0).rgb, vec3(SSR_RADIANCE_MAX));
    front = texelFetch(depths, at, 0).r;
    objects = front > 0.0 ? vec4(color, 1.0) : vec4(0.0); /* else undefined */
}
