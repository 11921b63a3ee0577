#version 460
#extension GL_GOOGLE_include_directive : require
#include "surface.h"

layout(set = 0, binding = SURFACE_HIGHLIGHTS) uniform sampler2D highlights;

layout(location = 0) out vec4 color; /* premultiplied: adds, and covers nothing */

void main()
{
    color = vec4(texelFetch(highlights, ivec2(gl_FragCoord.xy), 0).rrr, 0.0);
}
